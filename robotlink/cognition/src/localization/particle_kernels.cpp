// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/particle_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pitchboard::link::particles {

// What every processor of the kind has.
namespace narrow {
#include "localization/particle_loops.inc"
}  // namespace narrow

// Twice as wide. It has no fused multiply-add: the same operations, the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PITCHBOARD_WIDE_KERNELS
#pragma GCC push_options
#pragma GCC target("avx2")
namespace wide {
#include "localization/particle_loops.inc"
}  // namespace wide
#pragma GCC pop_options
#endif

const Kernels* kernelsOf(Width width) {
  if (width == Width::Narrow) return &narrow::all;
#ifdef PITCHBOARD_WIDE_KERNELS
  if (__builtin_cpu_supports("avx2")) return &wide::all;
#endif
  return nullptr;
}

const Kernels& kernels() {
  static const Kernels& best =
      kernelsOf(Width::Wide) ? *kernelsOf(Width::Wide) : *kernelsOf(Width::Narrow);
  return best;
}

}  // namespace pitchboard::link::particles
