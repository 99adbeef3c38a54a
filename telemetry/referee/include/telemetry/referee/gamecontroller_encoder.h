// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Encodes the GameController's packets for a simulated referee: the reverse of gamecontroller.h,
// from the same table of layouts. Pure functions; any thread.

#include <string>

#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::telemetry {

/// Returns the packet of state.version and state.size. Fields that this version does not have are
/// left out; bytes without a field (messages of coaches) are zero. Fails with Unsupported if there
/// is no such version and size, with InvalidArgument if a value does not fit (the context names
/// it).
Result<std::string> encodeReferee(const RefereeState& state);

/// Returns a robot's reply (RGrt) of reply.version: 1 (16 bytes), 2 (8) or 4 (32). Values that the
/// reply does not have become 0, and the ball "never seen". Fails with Unsupported for other
/// versions, with InvalidArgument if a number does not fit or is not finite.
Result<std::string> encodeReply(const RobotReply& reply);

/// Returns the size of a version's packet: `preferred` if the version has it, too. Nothing if the
/// version is unknown.
std::optional<int> refereePacketSize(int version, int preferred = 0);
std::optional<League> refereeLeague(int version, int size);
/// Returns the number of slots of a team; 0 if the version is unknown.
std::size_t refereeSlots(int version, int size);

/// Returns the packet of version 7 that the controllers of 2014 to 2016 send after each of theirs:
/// teams sorted by colour, the kick-off as a colour.
RefereeState asVersion7(const RefereeState& state);

}  // namespace pitchboard::telemetry
