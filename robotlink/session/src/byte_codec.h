// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Varints and doubles in a string of bytes, for the saved forms of this library. Private to
// robotlink.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace pitchboard::link {

inline void putVarint(std::string& out, std::uint64_t value) {
  while (value >= 0x80) {
    out.push_back(static_cast<char>(value | 0x80U));
    value >>= 7U;
  }
  out.push_back(static_cast<char>(value));
}

inline void putSigned(std::string& out, std::int64_t value) {
  putVarint(out,
            (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63));
}

/// The count of its leading bytes that are not all zero behind, then those bytes.
inline void putDouble(std::string& out, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int zeroBytes = bits == 0 ? 8 : std::countr_zero(bits) / 8;
  out.push_back(static_cast<char>(8 - zeroBytes));
  for (int byte = 7; byte >= zeroBytes; --byte) {
    out.push_back(static_cast<char>(bits >> static_cast<unsigned>(8 * byte)));
  }
}

/// Takes values off the front of bytes. After the first failure every value is 0 and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : m_bytes(bytes), m_size(bytes.size()) {}

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (m_bytes.empty()) break;
      const auto byte = static_cast<unsigned char>(m_bytes.front());
      m_bytes.remove_prefix(1);
      if (shift == 63 && byte > 1) break;
      value |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if (byte < 0x80) return value;
    }
    fail();
    return 0;
  }
  std::int64_t signedVarint() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
  }
  double real() {
    if (m_bytes.empty()) return fail(), 0.0;
    const auto count = static_cast<unsigned char>(m_bytes.front());
    if (count > 8 || count >= m_bytes.size()) return fail(), 0.0;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(m_bytes[i + 1]))
              << (56 - 8 * i);
    }
    m_bytes.remove_prefix(count + 1U);
    return std::bit_cast<double>(bits);
  }
  std::string_view bytes(std::uint64_t count) {
    if (count > m_bytes.size()) return fail(), std::string_view();
    const std::string_view taken = m_bytes.substr(0, count);
    m_bytes.remove_prefix(count);
    return taken;
  }

  bool ok() const { return m_ok; }
  void fail() {
    if (m_ok) m_failedAt = offset();
    m_ok = false;
    m_bytes = {};
  }
  std::string_view rest() const { return m_bytes; }
  std::size_t left() const { return m_bytes.size(); }
  /// Of the next value, or of the failure.
  std::size_t offset() const { return m_ok ? m_size - m_bytes.size() : m_failedAt; }

 private:
  std::string_view m_bytes;
  std::size_t m_size;
  std::size_t m_failedAt = 0;
  bool m_ok = true;
};

}  // namespace pitchboard::link
