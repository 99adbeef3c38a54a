// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The loops behind RandomBatch, once for each width of the processor's registers. All give the same
// bits. Pure functions on arrays of the caller.

#include <cstddef>
#include <cstdint>

#include <base/simd_level.h>

namespace pitchboard::random_loops {

/// Where n random blocks come from: arrays of the words of their keys and counters, and the stream
/// that they have in common.
struct Counters {
  const std::uint32_t *seedLow, *seedHigh, *tickLow, *high, *robot;
  std::uint32_t stream;
};

struct Loops {
  /// Philox4x32-10 for n counters: of each two whole numbers of 53 random bits.
  void (*fillWholes)(const Counters& counters, double* wholes, std::size_t n);
  /// The quantiles of n whole numbers, right in the middle of the normal law only.
  void (*fillNormals)(const double* wholes, double* normals, std::size_t n);
};

/// Returns null if the processor or compiler lacks this level.
const Loops* loopsOf(SimdLevel level);
/// Returns those of the highest level that the processor has.
const Loops& loops();

/// In the middle of its step, so that it is neither 0 nor 1.
inline double inside(double whole) {
  return (whole + 0.5) * 0x1.0p-53;
}

}  // namespace pitchboard::random_loops
