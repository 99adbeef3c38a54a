// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What states, set plays, penalties and colours are called in the packets of each league: one table
// for sending and for obeying. Private to robotlink/match.

#include <optional>

#include <simcore/world/game_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// Which penalties a version knows.
enum class PenaltyDialect { Humanoid2013, Humanoid2017, StandardPlatform, Soccer19, Soccer20 };
PenaltyDialect penaltyDialect(int version, telemetry::League league);

int penaltyCode(PenaltyDialect dialect, sim::PenaltyKind penalty);
sim::PenaltyKind penaltyOf(PenaltyDialect dialect, int code);

/// Codes of secState (Humanoid League; 0 where a version has none) or of setPlay.
int setPlayCode(telemetry::League league, int version, int size, sim::SetPlay play);
sim::SetPlay setPlayOf(telemetry::League league, int version, int size, int code);

/// The set play that a packet tells of, and the number of the team that takes it.
struct ToldSetPlay {
  sim::SetPlay kind = sim::SetPlay::None;
  std::optional<int> team;
};
ToldSetPlay setPlayIn(const telemetry::RefereeState& packet);

int colourCode(TeamColor colour);

}  // namespace pitchboard::link
