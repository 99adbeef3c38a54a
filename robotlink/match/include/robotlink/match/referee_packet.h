// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game of a simulated match as the GameController of its rules would send it, and as a screen
// shows it; and the other way round: a game that obeys such packets. Pure functions.

#include <optional>

#include <robotlink/frame/live_values.h>
#include <simcore/world/world_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// What robots are told now, of the rules' packet version. `truth`: without the delay with which
/// some leagues tell PLAYING. world.game is there.
telemetry::RefereeState refereePacket(const sim::WorldState& world, int packetNumber,
                                      bool truth = false);

/// What the scoreboard shows: the truth.
RefereeView refereeView(const sim::WorldState& world);
/// Of one robot; nothing while it may play.
std::optional<Penalty> refereePenalty(const sim::WorldState& world, const sim::RobotIdentity& robot);

/// Takes over what a referee's program says: state, half, times, score, set play, penalties. The
/// ball's and the robots' places stay ours.
void adoptPacket(const telemetry::RefereeState& packet, sim::WorldState& world);

}  // namespace pitchboard::link
