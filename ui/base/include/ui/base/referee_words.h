// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the referee says, as lines for the screen. Pure functions; seconds.

#include <QString>

#include <robotlink/frame/live_values.h>

namespace pitchboard::ui {

/// "PLAYING 05:12, first half, overtime, stopped".
QString refereeStateText(const link::RefereeView& view);
/// "corner kick for team 2, prepare, ready in 23 s"; "ball free in 8 s"; empty when there is
/// nothing of the kind.
QString refereeSetPlayText(const link::RefereeView& view);
/// "Really: PLAYING 05:10, ball free in 3 s"; empty without true data.
QString refereeTruthText(const link::RefereeView& view);
/// "RoboFEI, team 12 (blue), ours: 2 goals, 3 players left".
QString refereeTeamText(const link::RefereeTeamView& team, int ourTeam);
/// "05:12", "−00:07".
QString refereeClockText(int seconds);

}  // namespace pitchboard::ui
