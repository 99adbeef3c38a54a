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
#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::link {

/// Returns the packet that robots would receive now, already decoded, in the version of the rules.
/// With `truth`, PLAYING is announced without the delay that some leagues have. world.game must
/// exist.
telemetry::RefereeState refereePacket(const sim::WorldState& world, int packetNumber,
                                      bool truth = false);

/// Sets the frame's game and rules, the numbers of its teams, and its robots' penalties. Without a
/// game there are none. Slots of robots that are not in the frame are free there.
void showReferee(const std::optional<Game>& game, const std::optional<sim::RefereeRules>& rules,
                 MatchFrame& frame);

/// Version of the packets that have the teams in the order of their colours, not of their sides.
inline constexpr int versionByColour = 7;

/// Applies state, half, times, score, set play and penalties of a referee program's game to that of
/// the match. Ball and robots stay where they are. From now on, only such games change it
/// (sim::RefereeMemory::obeyed). `byColour`: it is of versionByColour.
void adoptGame(const Game& received, bool byColour, sim::WorldState& world);

/// Returns the rule set of the league and year that sends such packets.
sim::RefereeRules rulesOfPacket(int version, int size);

/// Sets teams and game of a scenario from a received game; field and robots must already be in it.
/// The scenario's rules are kept; if it has none, `rules` are used. `byColour` as in adoptGame().
/// Times are whole seconds. Error InvalidArgument, with the scenario unchanged, if it has robots of
/// more than two teams.
Result<void> takeGame(const Game& received, const sim::RefereeRules& rules, bool byColour,
                      Scenario& scenario);

}  // namespace pitchboard::link
