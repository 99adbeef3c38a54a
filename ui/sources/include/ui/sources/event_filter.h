// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Filters the events that the timeline shows and steps through, by kind and by robot. A plain
// value; any thread.

#include <set>

#include <robotlink/frame/match_event.h>

namespace pitchboard::ui {

struct EventFilter {
  std::set<link::MatchEventKind> hidden;
  std::set<RobotUid> robots;  ///< empty: all. Does not affect events without a robot

  /// Returns whether the event has a mark and passes the filter.
  bool shows(const link::MatchEvent& event) const {
    return link::isMarked(event) && !hidden.contains(event.kind) &&
           (robots.empty() || event.robot == RobotUid{} || robots.contains(event.robot));
  }
  bool isOn() const { return !hidden.empty() || !robots.empty(); }
  bool operator==(const EventFilter&) const = default;
};

}  // namespace pitchboard::ui
