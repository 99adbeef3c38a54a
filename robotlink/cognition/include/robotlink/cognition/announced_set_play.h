// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts set plays to and from the codes in each league's packets, for whoever sends or receives
// them. Pure functions; any thread.

#include <optional>

#include <simcore/world/game_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// Convert between set plays and codes: those of secState in the Humanoid League (0 if a version
/// has no such code), of setPlay in the others.
int setPlayCode(telemetry::League league, int version, int size, sim::SetPlay play);
sim::SetPlay setPlayOf(telemetry::League league, int version, int size, int code);

/// The set play in a packet, and the number of the team that takes it.
struct AnnouncedSetPlay {
  sim::SetPlay kind = sim::SetPlay::None;
  std::optional<int> team;
};
AnnouncedSetPlay setPlayIn(const telemetry::RefereeState& packet);

}  // namespace pitchboard::link
