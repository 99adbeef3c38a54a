// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Little-endian numbers, strings and maps of MCAP records, to and from bytes. The reading half
// never goes past its end: it turns bad and gives zeros from then on.

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

static_assert(std::endian::native == std::endian::little, "records are copied as they are");

template <class T>
void putNumber(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

/// Writes a number over bytes that stand already.
template <class T>
void setNumber(std::string& out, std::size_t at, T value) {
  std::memcpy(out.data() + at, &value, sizeof(T));
}

inline void putText(std::string& out, std::string_view text) {
  putNumber(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

inline void putMap(std::string& out, const McapMap& map) {
  const std::size_t at = out.size();
  putNumber(out, std::uint32_t{0});
  for (const auto& [key, value] : map) {
    putText(out, key);
    putText(out, value);
  }
  setNumber(out, at, static_cast<std::uint32_t>(out.size() - at - 4));
}

/// Opcode and room for the length; endRecord() fills it in.
inline std::size_t beginRecord(std::string& out, McapOp op) {
  out += static_cast<char>(op);
  putNumber(out, std::uint64_t{0});
  return out.size();
}
inline void endRecord(std::string& out, std::size_t begin) {
  setNumber(out, begin - 8, static_cast<std::uint64_t>(out.size() - begin));
}

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : m_bytes(bytes) {}

  template <class T>
  T number() {
    T value{};
    if (m_bytes.size() - m_at < sizeof(T)) {
      fail();
      return value;
    }
    std::memcpy(&value, m_bytes.data() + m_at, sizeof(T));
    m_at += sizeof(T);
    return value;
  }
  std::string_view bytes(std::uint64_t count) {
    if (count > m_bytes.size() - m_at) {
      fail();
      return {};
    }
    const auto out = m_bytes.substr(m_at, static_cast<std::size_t>(count));
    m_at += static_cast<std::size_t>(count);
    return out;
  }
  std::string_view text() { return bytes(number<std::uint32_t>()); }
  McapMap map() {
    McapMap out;
    ByteReader inside(text());
    while (inside.ok() && inside.left() > 0) {
      std::string key(inside.text());
      std::string value(inside.text());
      if (inside.ok()) out.insert_or_assign(std::move(key), std::move(value));
    }
    if (!inside.ok()) fail();
    return out;
  }
  std::size_t left() const { return m_bytes.size() - m_at; }
  std::size_t at() const { return m_at; }
  bool ok() const { return m_ok; }

 private:
  void fail() {
    m_ok = false;
    m_at = m_bytes.size();
  }
  std::string_view m_bytes;
  std::size_t m_at = 0;
  bool m_ok = true;
};

inline constexpr std::size_t recordHead = 9;  ///< opcode and length
inline constexpr std::size_t messageHead = 2 + 4 + 8 + 8;
inline constexpr std::size_t footerLength = 8 + 8 + 4;

}  // namespace pitchboard::telemetry
