// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The bytes of a CDR message (OMG DDS-XTypes 1.3, chapter 7.4), and what they are made of. Numbers
// are aligned as counted from behind the message's head. Private to recordings; one thread.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "ros_types.h"

namespace pitchboard::telemetry {

/// The bytes of a message. Never reads past the end: then ok() is false, and numbers are 0.
class CdrBytes {
 public:
  CdrBytes(std::string_view bytes, bool isSwapped, std::size_t maxAlignment)
      : m_message(bytes.data()),
        m_begin(bytes.data()),
        m_at(bytes.data()),
        m_end(bytes.data() + bytes.size()),
        m_maxAlignment(maxAlignment),
        m_isSwapped(isSwapped) {}

  template <class T>
  T number() {
    align(sizeof(T));
    if (left() < sizeof(T)) {
      fail();
      return T{};
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, m_at, sizeof(T));
    m_at += sizeof(T);
    if (m_isSwapped) std::reverse(bytes, bytes + sizeof(T));
    return std::bit_cast<T>(bytes);
  }
  std::string_view bytes(std::size_t count) {
    if (count > left()) {
      fail();
      return {};
    }
    const std::string_view taken(m_at, count);
    m_at += count;
    return taken;
  }
  void align(std::size_t size) {
    const std::size_t step = std::min(size, m_maxAlignment);
    const std::size_t over = static_cast<std::size_t>(m_at - m_begin) & (step - 1);
    if (over != 0) bytes(step - over);
  }
  /// What follows is aligned as if the message began here.
  const char* beginHere() { return std::exchange(m_begin, m_at); }
  void beginAt(const char* begin) { m_begin = begin; }

  bool ok() const { return m_ok; }
  void fail() {
    m_ok = false;
    m_at = m_end;
  }
  std::size_t left() const { return static_cast<std::size_t>(m_end - m_at); }
  /// Where a number of this size stands, counted from the beginning of the message.
  std::size_t placeOf(std::size_t size) const {
    const std::size_t step = std::min(size, m_maxAlignment);
    const std::size_t over = static_cast<std::size_t>(m_at - m_begin) & (step - 1);
    return static_cast<std::size_t>(m_at - m_message) + (over != 0 ? step - over : 0);
  }
  const char* at() const { return m_at; }
  const char* end() const { return m_end; }
  /// The end of the part that is read now; returns the one before.
  const char* limit(const char* end) { return std::exchange(m_end, end); }
  void jump(const char* to) { m_at = to; }

 private:
  const char* m_message;
  const char *m_begin, *m_at, *m_end;
  std::size_t m_maxAlignment;
  bool m_isSwapped;
  bool m_ok = true;
};

inline void appendUtf8(std::string& out, std::uint32_t c) {
  if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) c = 0xFFFD;
  const auto put = [&out](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0 | c >> 6U);
  } else {
    if (c < 0x10000) {
      put(0xE0 | c >> 12U);
    } else {
      put(0xF0 | c >> 18U);
      put(0x80 | (c >> 12U & 0x3FU));
    }
    put(0x80 | (c >> 6U & 0x3FU));
  }
  put(0x80 | (c & 0x3FU));
}

/// How the bytes of a message are laid out.
struct CdrFormat {
  bool isRos1 = false;
  bool isXcdr2 = false;
  bool hasListLengths = true;    ///< of XCDR2: some writers leave them out
  bool isParameterList = false;  ///< of XCDR1: the message is a list of members with numbers
  Extensibility unsaid = Extensibility::Final;
};

inline std::size_t sizeOfRos(RosKind kind) {
  switch (kind) {
    case RosKind::Bool:
    case RosKind::Int8:
    case RosKind::UInt8:
      return 1;
    case RosKind::Int16:
    case RosKind::UInt16:
      return 2;
    case RosKind::Int64:
    case RosKind::UInt64:
    case RosKind::Float64:
      return 8;
    case RosKind::LongDouble:
      return 16;
    default:
      return 4;
  }
}

/// A text as it stands in a message: with a NUL at its end, but in ROS 1.
inline std::string_view rosText(std::string_view bytes, bool isRos1) {
  if (!isRos1 && bytes.ends_with('\0')) bytes.remove_suffix(1);
  return bytes;
}

/// A time or a duration.
struct RosTime {
  std::int64_t seconds, rest;  ///< s, ns
  std::int64_t nanoseconds() const { return seconds * 1'000'000'000 + rest; }
  double inSeconds() const {
    return static_cast<double>(seconds) + static_cast<double>(rest) * 1e-9;
  }
};
/// In ROS 1 a time is unsigned, and a duration is two signed numbers.
inline RosTime rosTime(RosKind kind, std::int32_t first, std::uint32_t second, bool isRos1) {
  const bool isUnsigned = isRos1 && kind == RosKind::Time;
  return {isUnsigned ? std::int64_t{std::bit_cast<std::uint32_t>(first)} : std::int64_t{first},
          isRos1 && !isUnsigned ? std::int64_t{std::bit_cast<std::int32_t>(second)}
                                : std::int64_t{second}};
}

/// The value of an IEEE quadruple, as near as a double can be.
inline double fromQuadruple(std::span<const unsigned char, 16> bytes) {  // little-endian
  const int exponent = (bytes[15] & 0x7F) << 8 | bytes[14];
  double fraction = exponent == 0 ? 0.0 : 1.0;
  double scale = 1.0;
  for (int i = 13; i >= 6; --i) fraction += bytes[static_cast<std::size_t>(i)] * (scale /= 256.0);
  const double sign = (bytes[15] & 0x80) != 0 ? -1.0 : 1.0;
  if (exponent == 0x7FFF) {
    return fraction == 1.0 ? sign * std::numeric_limits<double>::infinity()
                           : std::numeric_limits<double>::quiet_NaN();
  }
  return sign * std::ldexp(fraction, exponent - 16383);
}

}  // namespace pitchboard::telemetry
