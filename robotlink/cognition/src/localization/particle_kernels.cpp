// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/particle_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace pitchboard::link::particles {

// What every processor of the kind has.
namespace narrow {
inline constexpr int registerLanes = 4;
#include "localization/particle_loops.inc"
}  // namespace narrow

// Wider ones. Of fused multiply-add nothing is used: the same operations, the same bits.
#ifdef PITCHBOARD_WIDE_REGISTERS
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

const Kernels* kernelsOf(RegisterWidth width) {
  if (!hasRegisters(width)) return nullptr;
#ifdef PITCHBOARD_WIDE_REGISTERS
  if (width == RegisterWidth::Wide) return &wide::all;
  if (width == RegisterWidth::Widest) return &widest::all;
#endif
  return &narrow::all;
}

const Kernels& kernels() {
  static const Kernels& best = widestLoops(kernelsOf);
  return best;
}

}  // namespace pitchboard::link::particles
