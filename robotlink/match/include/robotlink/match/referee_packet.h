// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game of a simulated match as the GameController of its rules would send it, and as a screen
// shows it; and the other way round: a game that obeys such packets. Pure functions.

#include <span>

#include <base/result.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/world/world_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// What robots are told now, as who hears a packet of the rules' version decodes it. `truth`:
/// without the delay with which some leagues tell PLAYING. world.game is there.
telemetry::RefereeState refereePacket(const sim::WorldState& world, int packetNumber,
                                      bool truth = false);

/// The scoreboard, and the penalties of the robots that are in the frame, from the packet with the
/// truth; none without a game.
void showReferee(const sim::WorldState& world, MatchFrame& frame);

/// Takes over what a referee's program says: state, half, times, score, set play, penalties. The
/// ball's and the robots' places stay ours. From now on the game is the program's
/// (GameState::obeyed).
void adoptPacket(const telemetry::RefereeState& packet, sim::WorldState& world);

/// The rules of the league and years of such packets.
sim::RefereeRules rulesOfPacket(const telemetry::RefereeState& packet);

/// The game that a packet tells of, into a scenario whose field and robots are there: rules (its
/// own, else those of the packet), teams and game. Times are whole seconds. Error InvalidArgument
/// when the scenario has robots of more than two teams; it is as before then.
Result<void> takeGame(const telemetry::RefereeState& packet, Scenario& scenario);

}  // namespace pitchboard::link
