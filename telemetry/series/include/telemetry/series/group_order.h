// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The order in which groups of rows are listed: in the tree of variables, as columns of a CSV file,
// in reports. Pure functions; any thread.

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Stores in the attribute "order" where a group of this robot is listed.
void setOrder(GroupInfo& group, const RobotOrder& order);
/// Returns what setOrder() stored; nothing for other groups, and in sessions from before 0.12.
std::optional<RobotOrder> orderOf(const GroupInfo& group);
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
