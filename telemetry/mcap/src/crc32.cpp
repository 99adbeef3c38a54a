// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/mcap/crc32.h>

#include <zlib.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace pitchboard::telemetry {
namespace {

std::uint32_t crcOfZlib(std::uint32_t crc, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

#if defined(__x86_64__)
// V. Gopal and others, "Fast CRC Computation for Generic Polynomials Using PCLMULQDQ Instruction"
// (Intel, 2009): 64 bytes at a time are multiplied by powers of x modulo the polynomial, so that
// they can be added to the next 64. The constants are those of its bit-reflected example.
#define PITCHBOARD_CLMUL __attribute__((target("pclmul,sse4.1")))
constexpr std::size_t clmulBlock = 64;

PITCHBOARD_CLMUL __m128i loadedAt(const char* at) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
}

/// `sum` moved ahead by the distance that `factors` stand for, and `next` added.
PITCHBOARD_CLMUL __m128i foldedOnto(__m128i sum, __m128i factors, __m128i next) {
  const __m128i low = _mm_clmulepi64_si128(sum, factors, 0x00);
  const __m128i high = _mm_clmulepi64_si128(sum, factors, 0x11);
  return _mm_xor_si128(_mm_xor_si128(low, high), next);
}

/// The remainder of 128 bits.
PITCHBOARD_CLMUL std::uint32_t reduced(__m128i sum, __m128i by16) {
  const __m128i lowWords = _mm_setr_epi32(~0, 0, ~0, 0);
  sum = _mm_xor_si128(_mm_srli_si128(sum, 8), _mm_clmulepi64_si128(sum, by16, 0x10));
  const __m128i by8 = _mm_set_epi64x(0, 0x0163cd6124);
  sum = _mm_xor_si128(_mm_srli_si128(sum, 4),
                      _mm_clmulepi64_si128(_mm_and_si128(sum, lowWords), by8, 0x00));
  const __m128i barrett = _mm_set_epi64x(0x01f7011641, 0x01db710641);
  __m128i part = _mm_clmulepi64_si128(_mm_and_si128(sum, lowWords), barrett, 0x10);
  part = _mm_clmulepi64_si128(_mm_and_si128(part, lowWords), barrett, 0x00);
  return static_cast<std::uint32_t>(_mm_extract_epi32(_mm_xor_si128(sum, part), 1));
}

/// `size` is a multiple of 16, and at least one block.
PITCHBOARD_CLMUL std::uint32_t crcOfBlocks(std::uint32_t crc, const char* at, std::size_t size) {
  const __m128i by64 = _mm_set_epi64x(0x01c6e41596, 0x0154442bd4);
  const __m128i by16 = _mm_set_epi64x(0x00ccaa009e, 0x01751997d0);
  const char* const end = at + size;
  __m128i a = _mm_xor_si128(loadedAt(at), _mm_cvtsi32_si128(static_cast<int>(~crc)));
  __m128i b = loadedAt(at + 16), c = loadedAt(at + 32), d = loadedAt(at + 48);
  for (at += clmulBlock; end - at >= static_cast<std::ptrdiff_t>(clmulBlock); at += clmulBlock) {
    a = foldedOnto(a, by64, loadedAt(at));
    b = foldedOnto(b, by64, loadedAt(at + 16));
    c = foldedOnto(c, by64, loadedAt(at + 32));
    d = foldedOnto(d, by64, loadedAt(at + 48));
  }
  a = foldedOnto(foldedOnto(foldedOnto(a, by16, b), by16, c), by16, d);
  for (; at < end; at += 16) a = foldedOnto(a, by16, loadedAt(at));
  return ~reduced(a, by16);
}
#endif

}  // namespace

std::uint32_t extendedCrc(std::uint32_t crc, std::string_view bytes) {
#if defined(__x86_64__)
  static const bool canMultiply =
      __builtin_cpu_supports("pclmul") != 0 && __builtin_cpu_supports("sse4.1") != 0;
  if (canMultiply && bytes.size() >= clmulBlock) {
    const std::size_t blocks = bytes.size() / 16 * 16;
    crc = crcOfBlocks(crc, bytes.data(), blocks);
    bytes.remove_prefix(blocks);
  }
#endif
  return bytes.empty() ? crc : crcOfZlib(crc, bytes);
}

std::uint32_t joinedCrc(std::uint32_t first, std::uint32_t second, std::uint64_t size) {
  return static_cast<std::uint32_t>(crc32_combine(first, second, static_cast<z_off_t>(size)));
}

}  // namespace pitchboard::telemetry
