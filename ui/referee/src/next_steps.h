// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a referee can do next. Pure; any thread.

#include <QString>
#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/rules/referee.h>

namespace pitchboard::ui {

struct NextStep {
  std::optional<sim::RefereeCall> call;  ///< nothing: the match is played again, or skips
  QString text, tip;
  bool skips = false;  ///< to kick-off
};

/// At most three, the usual one first; each is allowed by sim::checkCall().
std::vector<NextStep> nextSteps(const Game& game, const sim::RefereeRules& rules);

/// "BLUE".
QString teamText(const GameTeam& team);

}  // namespace pitchboard::ui
