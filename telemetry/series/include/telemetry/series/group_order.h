// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The order in which groups of rows are listed: in the tree of variables, as columns of a CSV file,
// in reports. Pure functions; any thread.

#include <algorithm>
#include <functional>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Compares two groups: groups without an order come first, then the robots in their order, each
/// robot before its further groups.
bool isListedBefore(const GroupInfo& group, const GroupInfo& other);

/// Returns the indices of `groups` in the order of the list. `infoOf` returns the GroupInfo of one.
template <class Groups, class InfoOf>
std::vector<std::size_t> listedOrder(const Groups& groups, InfoOf infoOf) {
  std::vector<std::size_t> places(groups.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  std::ranges::stable_sort(places, [&](std::size_t a, std::size_t b) {
    return isListedBefore(std::invoke(infoOf, groups[a]), std::invoke(infoOf, groups[b]));
  });
  return places;
}

}  // namespace pitchboard::telemetry
