// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Starts a game from the situation that a GameStart describes, and describes a running game as a
// GameStart. Seconds are rounded to ticks in such a way that they convert back unchanged. Pure
// functions of the world's state; any thread.

#include <simcore/rules/referee.h>
#include <simcore/world/game_start.h>

namespace pitchboard::sim {

/// Applies `start` to the game that newGame() made. Robots stay where they are; only a set play
/// that begins may move the ball. Error InvalidArgument if `start` names a team or robot that does
/// not play, or if its values contradict each other; world.game must not be used after an error.
Result<void> startGame(WorldState& world, const Snapshot& now, const GameStart& start,
                       Placements& placements, std::vector<Event>& events);

/// Returns the GameStart from which startGame() makes world.game again. Two things are lost: what
/// the automatic referee remembers of each robot (for how long it has been down, outside, or
/// pushing), and players who have left the field. world.game must exist.
GameStart gameStartOf(const WorldState& world);

}  // namespace pitchboard::sim
