// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Formats the referee's data as text for the screen. Times are in seconds. Pure functions; any
// thread.

#include <QString>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

// Of a frame that has a game:

/// Returns, for example, "PLAYING 05:12, first half, overtime, stopped".
QString refereeStateText(const link::MatchFrame& frame);
/// Returns, for example, "corner kick for team 2, prepare, ready in 23 s" or "ball free in 8 s";
/// empty if there is no set play or restart.
QString refereeSetPlayText(const link::MatchFrame& frame);
/// Returns, for example, "True state: PLAYING 05:10, ball free in 3 s"; empty without true data.
QString refereeTruthText(const link::MatchFrame& frame);
/// Returns, for example, "RoboFEI, team 12 (blue), ours: 2 goals, 3 players left".
QString refereeTeamText(const link::MatchFrame& frame, const GameTeam& team);
/// Returns the team's name, or its colour: "RoboFEI", "BLUE", "TEAM 12".
QString refereeTeamName(const link::MatchFrame& frame, const GameTeam& team);

/// Returns what labelOf() says.
inline QString labelText(const auto& value) {
  const std::string_view label = labelOf(value);
  return QString::fromUtf8(label.data(), static_cast<qsizetype>(label.size()));
}
/// Returns, for example, "pickup 23 s" for "pickup or incapable": short, so that the seconds fit.
QString penaltyTag(const link::Penalty& penalty);
/// Returns, for example, "05:12" or "−00:07".
QString refereeClockText(int seconds);

}  // namespace pitchboard::ui
