// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_loops.h"

#include <Random123/philox.h>

#include "normal_quantile.h"

namespace pitchboard::draws {
namespace {

/// The upper 53 of 64 bits; conversions from signed words are what processors can do in vectors.
inline double whole(std::uint32_t upper, std::uint32_t lower) {
  return (static_cast<double>(static_cast<std::int32_t>(upper ^ 0x80000000U)) + 0x1p31) * 0x1p21 +
         static_cast<double>(static_cast<std::int32_t>(lower >> 11));
}

}  // namespace

// What every processor of the kind has.
namespace narrow {
#include "draw_loops.inc"
}  // namespace narrow

// Wider ones. Of fused multiply-add nothing is used: the same operations, the same bits.
#ifdef PITCHBOARD_WIDE_REGISTERS
#pragma GCC push_options
#pragma GCC target("avx2")
namespace wide {
#include "draw_loops.inc"
}  // namespace wide
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")
namespace widest {
#include "draw_loops.inc"
}  // namespace widest
#pragma GCC pop_options
#endif

const Loops* loopsOf(RegisterWidth width) {
  if (!hasRegisters(width)) return nullptr;
#ifdef PITCHBOARD_WIDE_REGISTERS
  if (width == RegisterWidth::Wide) return &wide::all;
  if (width == RegisterWidth::Widest) return &widest::all;
#endif
  return &narrow::all;
}

const Loops& loops() {
  static const Loops& best = widestLoops(loopsOf);
  return best;
}

}  // namespace pitchboard::draws
