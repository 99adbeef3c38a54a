// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads values one after the other from bytes of a file. It never reads past the end: at the first
// missing value it fails, and from then on returns zeros and empty values. Formats derive their own
// readers from it. The bytes belong to the caller. One thread at a time.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace pitchboard {

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : m_rest(bytes), m_size(bytes.size()) {}

  /// Reads a little-endian number.
  template <class T>
  T number() {
    static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");
    T value{};
    const std::string_view taken = bytes(sizeof(T));
    if (!taken.empty()) std::memcpy(&value, taken.data(), sizeof(T));
    return value;
  }
  std::string_view bytes(std::uint64_t count) {
    if (count > m_rest.size()) {
      fail();
      return {};
    }
    const std::string_view taken = m_rest.substr(0, static_cast<std::size_t>(count));
    m_rest.remove_prefix(static_cast<std::size_t>(count));
    return taken;
  }

  bool ok() const { return m_ok; }
  void fail() {
    if (m_ok) m_failedAt = offset();
    m_ok = false;
    m_rest = {};
  }
  std::string_view rest() const { return m_rest; }
  std::size_t left() const { return m_rest.size(); }
  /// Returns the position of the next value, or of the failure.
  std::size_t offset() const { return m_ok ? m_size - m_rest.size() : m_failedAt; }

 private:
  std::string_view m_rest;
  std::size_t m_size;
  std::size_t m_failedAt = 0;
  bool m_ok = true;
};

}  // namespace pitchboard
