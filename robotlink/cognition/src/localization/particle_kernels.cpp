// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/particle_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

namespace pitchboard::link::particles {

// What every processor of the kind has.
namespace narrow {
inline constexpr int registerLanes = 4;
#include "localization/particle_loops.inc"
}  // namespace narrow

// Wider ones. Of fused multiply-add nothing is used: the same operations, the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PITCHBOARD_WIDE_KERNELS
#pragma GCC push_options
#pragma GCC target("avx2")
namespace wide {
inline constexpr int registerLanes = 8;
#include "localization/particle_loops.inc"
}  // namespace wide
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")
namespace widest {
inline constexpr int registerLanes = 16;
#include "localization/particle_loops.inc"
}  // namespace widest
#pragma GCC pop_options
#endif

const Kernels* kernelsOf(Width width) {
  if (width == Width::Narrow) return &narrow::all;
#ifdef PITCHBOARD_WIDE_KERNELS
  if (width == Width::Wide && __builtin_cpu_supports("avx2")) return &wide::all;
  // Processors that lack vbmi2 have the registers, but slow down for everything when they are used.
  if (width == Width::Widest && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vbmi2")) {
    return &widest::all;
  }
#endif
  return nullptr;
}

const Kernels& kernels() {
  static const Kernels& best = [] {
    for (const Width width : {Width::Widest, Width::Wide}) {
      if (const Kernels* found = kernelsOf(width)) return std::cref(*found);
    }
    return std::cref(*kernelsOf(Width::Narrow));
  }();
  return best;
}

}  // namespace pitchboard::link::particles
