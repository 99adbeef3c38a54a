// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes the GameController's packets, for a simulated referee: the other direction of
// gamecontroller.h, from the same table of layouts. Pure functions.

#include <string>

#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::telemetry {

/// The packet of state.version and state.size. Fields that this version does not have are left
/// out; bytes that belong to no field (messages of coaches) are zero. Errors: Unsupported (no such
/// version and size), InvalidArgument (a value does not fit its field; the context names it).
Result<std::string> encodeReferee(const RefereeState& state);

/// A robot's reply (RGrt) of reply.version: 1 (16 bytes), 2 (8) or 4 (32). What this version does
/// not have is left out, and what it has and is not said is 0; of the ball "never seen". Errors:
/// Unsupported (no such version), InvalidArgument (a number does not fit, or is not finite).
Result<std::string> encodeReply(const RobotReply& reply);

/// The size of a version's packet; `preferred` where a version has several. Nothing when the
/// version is unknown.
std::optional<int> refereePacketSize(int version, int preferred = 0);
std::optional<League> refereeLeague(int version, int size);
/// Slots of a team in this version; 0 when it is unknown.
std::size_t refereeSlots(int version, int size);

/// The packet of version 7 that the controllers of 2014 to 2016 send behind each of theirs: teams
/// in the order of their colours, the kick-off as a colour.
RefereeState asVersion7(const RefereeState& state);

}  // namespace pitchboard::telemetry
