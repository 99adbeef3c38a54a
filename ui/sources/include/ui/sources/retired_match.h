// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A match that has been replaced and can be brought back by undo. Only the match replaced last
// keeps its rows, states and drawings. A value; UI thread only.

#include <memory>
#include <optional>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/match/moment.h>
#include <telemetry/session/drawn_notes.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>

namespace pitchboard::ui {

struct RetiredMatch {
  link::Scenario scenario;             ///< its last moment, with all robots
  link::Scenario beginning;            ///< what MatchController::restart() plays
  std::optional<link::Moment> moment;  ///< empty if it was still being opened
  link::MatchOptions options;          ///< the options with which it was opened
  std::shared_ptr<const link::VariableCatalog> catalog;
  bool paused = false;
  MatchMemory::Kept memory;
  std::vector<link::MatchEvent> events;     ///< the events of the timeline
  std::vector<telemetry::DrawnNote> drawn;  ///< what the user drew
};

}  // namespace pitchboard::ui
