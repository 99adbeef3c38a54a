// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which events a person wants to see on the timeline and to step through: kinds that are left out,
// and robots to whom the events of robots are limited. A plain value; any thread.

#include <set>
#include <string>

#include <robotlink/frame/match_event.h>

namespace pitchboard::ui {

struct EventFilter {
  std::set<link::MatchEventKind> hidden;
  std::set<std::string> robots;  ///< "B1"; empty: all. Events of no robot are always shown

  /// Has a mark, and nobody left it out.
  bool shows(const link::MatchEvent& event) const {
    return link::isMarked(event) && !hidden.contains(event.kind) &&
           (robots.empty() || event.name.empty() || robots.contains(event.name));
  }
  bool isOn() const { return !hidden.empty() || !robots.empty(); }
  bool operator==(const EventFilter&) const = default;
};

}  // namespace pitchboard::ui
