// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The order in which groups of rows are listed: in trees of variables, as columns of a CSV, in
// reports. Pure functions; any thread.

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Notes in the attributes ("order") where a group of this robot is listed.
void setOrder(GroupInfo& group, const RobotOrder& order);
/// As setOrder() noted it; nothing for other groups and for those of sessions before 0.12.
std::optional<RobotOrder> orderOf(const GroupInfo& group);
/// Robots in their order, each before other groups of it; groups without an order come first.
bool isListedBefore(const GroupInfo& group, const GroupInfo& other);

/// Places in `groups` as they are listed. `infoOf`: the GroupInfo of one of them.
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
