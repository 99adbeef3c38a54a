// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What penalties and colours are called in the packets of each league: one table for sending and
// for obeying. Private to robotlink/match.

#include <simcore/world/game_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// Which penalties a version knows.
enum class PenaltyDialect { Humanoid2013, Humanoid2017, StandardPlatform, Soccer19, Soccer20 };
PenaltyDialect penaltyDialect(int version, telemetry::League league);

int penaltyCode(PenaltyDialect dialect, sim::PenaltyKind penalty);
sim::PenaltyKind penaltyOf(PenaltyDialect dialect, int code);

int colourCode(TeamColor colour);

}  // namespace pitchboard::link
