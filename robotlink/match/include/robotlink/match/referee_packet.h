// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts between the game of a simulated match and GameController packets: makes the packet that
// the GameController of its rules would send, shows it on the scoreboard, and lets a game follow
// received packets. Pure functions; any thread.

#include <span>

#include <base/result.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/world/world_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// Returns the packet that robots would receive now, already decoded, in the version of the rules.
/// With `truth`, PLAYING is announced without the delay that some leagues have. world.game must
/// exist.
telemetry::RefereeState refereePacket(const sim::WorldState& world, int packetNumber,
                                      bool truth = false);

/// Sets the frame's scoreboard, team numbers and penalties from the packet with the truth. Does
/// nothing without a game.
void showReferee(const sim::WorldState& world, MatchFrame& frame);

/// Applies state, half, times, score, set play and penalties of a referee program's packet to the
/// game. Ball and robots stay where they are. From now on, only such packets change the game
/// (GameState::obeyed).
void adoptPacket(const telemetry::RefereeState& packet, sim::WorldState& world);

/// Returns the rule set of the league and year that sends such packets.
sim::RefereeRules rulesOfPacket(const telemetry::RefereeState& packet);

/// Sets teams and game of a scenario from a packet; field and robots must already be in it. The
/// scenario's rules are kept; if it has none, those of the packet are used. Times are whole
/// seconds. Error InvalidArgument, with the scenario unchanged, if it has robots of more than two
/// teams.
Result<void> takeGame(const telemetry::RefereeState& packet, Scenario& scenario);

}  // namespace pitchboard::link
