// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A referee's packet as it is shown, wherever it comes from: the network, a simulated match, a
// recording. Pure functions; any thread.

#include <optional>

#include <robotlink/frame/live_values.h>
#include <robotlink/frame/teams.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// All that the packet says, with the names of these teams; from whom and when, which team is ours,
/// true data and replies are left to the caller.
RefereeView viewOf(const telemetry::RefereeState& packet, const Teams& teams = {});

/// True data (RGTD) beside it; the caller knows their age.
RefereeTruth truthOf(const telemetry::RefereeState& trueData);

/// Of the player in this slot of the team with this number, substitutes included; nothing while it
/// may play, or when the packet does not know it.
std::optional<Penalty> penaltyOf(const telemetry::RefereeState& packet, int team, int player);

}  // namespace pitchboard::link
