// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A match that is not played any more and can come back as it was. A value; rows, states and
// drawings are shared, and are there only of the match that was replaced last. UI thread.

#include <memory>
#include <optional>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/match/moment.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>

namespace pitchboard::ui {

struct RetiredMatch {
  link::Scenario scenario;             ///< its present moment, with everybody who plays
  link::Scenario beginning;            ///< what restart() plays
  std::optional<link::Moment> moment;  ///< nothing: it was still being opened
  link::MatchOptions options;          ///< it was opened with
  std::shared_ptr<const link::VariableCatalog> catalog;
  bool paused = false;
  MatchMemory::Kept memory;
  std::vector<link::MatchEvent> events;  ///< as the timeline had them
};

}  // namespace pitchboard::ui
