// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What set plays are called in the packets of each league: one table for sending, for obeying and
// for robots that hear them. Any thread; pure functions.

#include <optional>

#include <simcore/world/game_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// Codes of secState (Humanoid League; 0 where a version has none) or of setPlay.
int setPlayCode(telemetry::League league, int version, int size, sim::SetPlay play);
sim::SetPlay setPlayOf(telemetry::League league, int version, int size, int code);

/// The set play that a packet tells of, and the number of the team that takes it.
struct ToldSetPlay {
  sim::SetPlay kind = sim::SetPlay::None;
  std::optional<int> team;
};
ToldSetPlay setPlayIn(const telemetry::RefereeState& packet);

}  // namespace pitchboard::link
