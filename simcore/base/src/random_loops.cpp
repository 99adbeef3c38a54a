// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_loops.h"

#include <Random123/philox.h>

#include "normal_quantile.h"

namespace pitchboard::random_loops {
namespace {

/// The upper 53 of 64 bits; conversions from signed words are what processors can do in vectors.
inline double whole(std::uint32_t upper, std::uint32_t lower) {
  return (static_cast<double>(static_cast<std::int32_t>(upper ^ 0x80000000U)) + 0x1p31) * 0x1p21 +
         static_cast<double>(static_cast<std::int32_t>(lower >> 11));
}

}  // namespace

// Instructions that every processor of the architecture has.
namespace baseline {
#include "random_loops.inc"
}  // namespace baseline

// Longer vectors. No fused multiply-add is used, so that the same operations give the same bits.
#ifdef PITCHBOARD_SIMD_LEVELS
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
#include "random_loops.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")
namespace avx512 {
#include "random_loops.inc"
}  // namespace avx512
#pragma GCC pop_options
constexpr SimdLoops<Loops> levels{&baseline::all, &avx2::all, &avx512::all};
#else
constexpr SimdLoops<Loops> levels{&baseline::all};
#endif

const Loops* loopsOf(SimdLevel level) {
  return levels.at(level);
}

const Loops& loops() {
  static const Loops& best = levels.fastest();
  return best;
}

}  // namespace pitchboard::random_loops
