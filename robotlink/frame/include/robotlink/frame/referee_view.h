// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A referee's packet as it is shown, wherever it comes from: the network, a simulated match, a
// recording. Pure functions; any thread.

#include <optional>

#include <robotlink/frame/live_values.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// All that the packet says; from whom and when, true data and replies are left to the caller.
/// `ourTeam`: the number of the team whose side is taken.
RefereeView viewOf(const telemetry::RefereeState& packet, int ourTeam = 0);

/// True data (RGTD) beside it; the caller knows their age.
RefereeTruth truthOf(const telemetry::RefereeState& trueData);

/// Of the player in this slot of the team with this number, substitutes included; nothing while it
/// may play, or when the packet does not know it.
std::optional<Penalty> penaltyOf(const telemetry::RefereeState& packet, int team, int player);

}  // namespace pitchboard::link
