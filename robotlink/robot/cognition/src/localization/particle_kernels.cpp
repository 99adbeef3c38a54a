// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/particle_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace pitchboard::link::particles {

// Instructions that every processor of the architecture has.
namespace baseline {
inline constexpr int registerLanes = 4;
#include "localization/particle_loops.inc"
}  // namespace baseline

// Longer vectors. No fused multiply-add is used, so that the same operations give the same bits.
#ifdef PITCHBOARD_SIMD_LEVELS
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
inline constexpr int registerLanes = 8;
#include "localization/particle_loops.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")
namespace avx512 {
inline constexpr int registerLanes = 16;
#include "localization/particle_loops.inc"
}  // namespace avx512
#pragma GCC pop_options
constexpr SimdLoops<Kernels> levels{&baseline::all, &avx2::all, &avx512::all};
#else
constexpr SimdLoops<Kernels> levels{&baseline::all};
#endif

const Kernels* kernelsOf(SimdLevel level) {
  return levels.at(level);
}

const Kernels& kernels() {
  static const Kernels& best = levels.fastest();
  return best;
}

}  // namespace pitchboard::link::particles
