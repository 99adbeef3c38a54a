// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counts values in equal bins. Pure function; any thread.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pitchboard::telemetry {

/// Counts the values in `bins` equal bins from `low` to `high`, both included. Values that are not
/// finite are ignored.
inline std::vector<std::size_t> histogram(std::span<const double> values, double low, double high,
                                          std::size_t bins) {
  std::vector<std::size_t> counts(bins, 0);
  if (bins == 0) return counts;
  for (const double value : values) {
    if (!std::isfinite(value) || value < low || value > high) continue;
    const double share = high > low ? (value - low) / (high - low) : 0.0;
    const auto bin = static_cast<std::size_t>(share * static_cast<double>(bins));
    ++counts[std::min(bin, bins - 1)];
  }
  return counts;
}

}  // namespace pitchboard::telemetry
