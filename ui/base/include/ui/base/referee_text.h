// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Formats the referee's data as text for the screen. Times are in seconds. Pure functions; any
// thread.

#include <QString>
#include <string>

#include <robotlink/frame/live_values.h>

namespace pitchboard::ui {

/// Returns, for example, "PLAYING 05:12, first half, overtime, stopped".
QString refereeStateText(const link::RefereeView& view);
/// Returns, for example, "corner kick for team 2, prepare, ready in 23 s" or "ball free in 8 s";
/// empty if there is no set play or restart.
QString refereeSetPlayText(const link::RefereeView& view);
/// Returns, for example, "Really: PLAYING 05:10, ball free in 3 s"; empty without true data.
QString refereeTruthText(const link::RefereeView& view);
/// Returns, for example, "RoboFEI, team 12 (blue), ours: 2 goals, 3 players left".
QString refereeTeamText(const link::RefereeTeamView& team, int ourTeam);
/// Returns, for example, "pickup 23 s" for "pickup or incapable": short, so that the seconds fit.
QString penaltyTag(const std::string& penalty, int secondsLeft);
/// Returns, for example, "05:12" or "−00:07".
QString refereeClockText(int seconds);

}  // namespace pitchboard::ui
