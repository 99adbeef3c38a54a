// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Varints and doubles in a string of bytes, for the saved states of a match. Any thread.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include <base/byte_reader.h>

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

/// The values that the functions above wrote.
class CodecReader : public ByteReader {
 public:
  using ByteReader::ByteReader;

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = number<std::uint8_t>();
      if (!ok() || (shift == 63 && byte > 1)) break;
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
    if (left() == 0) return fail(), 0.0;
    const auto count = static_cast<unsigned char>(rest().front());
    if (count > 8 || count >= left()) return fail(), 0.0;
    const std::string_view digits = bytes(count + 1U).substr(1);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(digits[i])) << (56 - 8 * i);
    }
    return std::bit_cast<double>(bits);
  }
};

}  // namespace pitchboard::link
