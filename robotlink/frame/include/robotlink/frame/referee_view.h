// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes what the screen shows of a referee's packet, whether it comes from the network, a simulated
// match or a recording. Pure functions; any thread.

#include <optional>

#include <robotlink/frame/live_values.h>
#include <robotlink/frame/teams.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// Returns everything that the packet contains, with the names of these teams. The caller sets what
/// a packet does not contain: sender, time, our team, true data and replies.
RefereeView viewOf(const telemetry::RefereeState& packet, const Teams& teams = {});

/// Returns what a packet of true data (RGTD) contains. The caller sets its age.
RefereeTruth truthOf(const telemetry::RefereeState& trueData);

/// Returns the penalty of the player in slot `player` of the team with number `team`; substitutes
/// have one, too. Empty if the player may play or is not in the packet.
std::optional<Penalty> penaltyOf(const telemetry::RefereeState& packet, int team, int player);

}  // namespace pitchboard::link
