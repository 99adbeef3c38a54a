// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Begins a game where a GameStart says, and makes one of a game that is under way. Pure functions
// over the state of the world; seconds become ticks and come back as they were. Any thread.

#include <simcore/rules/referee.h>
#include <simcore/world/game_start.h>

namespace pitchboard::sim {

/// Puts `start` over the game that newGame() has made. Robots stay where they are; only a set play
/// that begins may put the ball. Errors (world.game is spoilt then): InvalidArgument when a team or
/// a robot is named that does not play, or the game is none.
Result<void> startGame(WorldState& world, const Snapshot& now, const GameStart& start,
                       Placements& placements, std::vector<Event>& events);

/// The inverse: startGame(gameStartOf(world)) gives world.game again, but for what the automatic
/// referee remembers of each robot (how long it lies, stands outside, pushes), and for players who
/// are not on the field any more. `world.game` is there.
GameStart gameStartOf(const WorldState& world);

}  // namespace pitchboard::sim
