// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes quantiles of sorted values. Pure function; any thread.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <ranges>

namespace pitchboard::telemetry {

/// Interpolates linearly (numpy's default, R's type 7); NaN for no values. `share` is 0 to 1.
double quantile(const std::ranges::random_access_range auto& sorted, double share) {
  const std::size_t count = std::size(sorted);
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(count - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, count - 1);
  const double part = at - static_cast<double>(low);
  return sorted[low] + part * (sorted[high] - sorted[low]);
}

}  // namespace pitchboard::telemetry
