// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses, while the program runs, between loops that were compiled once for each SIMD level. All
// levels give the same bits, because none uses fused multiply-add; only the speed differs. Pure
// functions; any thread.
//
// A file with such loops compiles them under PITCHBOARD_SIMD_LEVELS, behind
// `#pragma GCC target("avx2")` for Avx2 and behind
// `#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")` for Avx512.

#include <initializer_list>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PITCHBOARD_SIMD_LEVELS
#endif

namespace pitchboard {

enum class SimdLevel {
  Baseline,  ///< instructions that every processor of the architecture has
  Avx2,      ///< vectors of 256 bits
  Avx512     ///< vectors of 512 bits
};

/// Returns whether the compiler can use this level and the processor runs it without slowing down.
bool supports(SimdLevel level);

/// The same loops, compiled for each level; null where a level has none of its own.
template <class Loops>
struct SimdLoops {
  const Loops* baseline;
  const Loops* avx2 = nullptr;
  const Loops* avx512 = nullptr;

  /// Returns null if the level is not supported.
  const Loops* at(SimdLevel level) const {
    if (!supports(level)) return nullptr;
    if (level == SimdLevel::Avx2) return avx2;
    return level == SimdLevel::Avx512 ? avx512 : baseline;
  }
  /// Returns those of the highest supported level.
  const Loops& fastest() const {
    for (const SimdLevel level : {SimdLevel::Avx512, SimdLevel::Avx2}) {
      if (const Loops* found = at(level)) return *found;
    }
    return *baseline;
  }
};

}  // namespace pitchboard
