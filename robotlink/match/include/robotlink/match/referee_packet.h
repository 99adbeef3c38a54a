// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game of a simulated match as the GameController of its rules would send it, and as a screen
// shows it; and the other way round: a game that obeys such packets. Pure functions.

#include <robotlink/frame/match_frame.h>
#include <simcore/world/world_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// What robots are told now, as who hears a packet of the rules' version decodes it. `truth`:
/// without the delay with which some leagues tell PLAYING. world.game is there.
telemetry::RefereeState refereePacket(const sim::WorldState& world, int packetNumber,
                                      bool truth = false);

/// The scoreboard, the numbers of the frame's teams and the penalties of its robots, from the
/// packet with the truth; none without a game.
void showReferee(const sim::WorldState& world, MatchFrame& frame);

/// Takes over what a referee's program says: state, half, times, score, set play, penalties. The
/// ball's and the robots' places stay ours.
void adoptPacket(const telemetry::RefereeState& packet, sim::WorldState& world);

}  // namespace pitchboard::link
