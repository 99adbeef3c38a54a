// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee of a simulated match: a machine of states that follows calls (a person's, a
// program's, its own), and an automatic referee that makes them. Pure functions over the state of
// the world, which holds the game, and what the tick did; where bodies are to be put is an answer,
// which the simulation carries out. Metres, radians, ticks. Any thread.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <base/result.h>
#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::sim {

enum class CallKind : std::uint8_t {
  State,     ///< state
  KickOff,   ///< team; nobody: drop ball. Who kicks off next
  Goal,      ///< team; value: +1 or −1
  SetPlay,   ///< team, setPlay, place
  NextStep,  ///< of a set play, up to the ball being in play
  DropBall,  ///< nobody's ball: READY, ball on the centre mark
  Penalise,  ///< robot, penalty
  Pardon,    ///< robot
  Card,      ///< robot; value: 0 warning, 1 yellow, 2 red
  NextHalf,  ///< after FINISHED
  ShootOut,  ///< after FINISHED
  Timeout,   ///< team; nobody: the referee's own
  Stop,      ///< play is stopped
  GoOn,      ///<
  Automatic  ///< value: 1 the referee calls by itself, 0 it does not
};

struct RefereeCall {
  CallKind kind = CallKind::State;
  PlayState state = PlayState::Initial;
  int team = GameState::nobody;  ///< index of GameState::teams
  RobotId robot{};
  SetPlay setPlay = SetPlay::None;
  PenaltyKind penalty = PenaltyKind::None;
  int value = 0;
  std::optional<Point> place{};
  std::uint32_t cause = 0;  ///< is told with the events that follow from it at once
  bool operator==(const RefereeCall&) const = default;
};

/// Where bodies are to be put, with what they are. Scratch of a tick.
struct Placements {
  std::optional<Point> ball;
  std::vector<std::pair<std::size_t, Pose>> robots;  ///< by index
  void clear() {
    ball.reset();
    robots.clear();
  }
};

/// The game before its first whistle: of the teams of the settings, or of the colours on the field.
/// `now`: where everybody stands; the robot nearest to its goal keeps it. Robots are told where
/// their team attacks. Error InvalidArgument when more than two teams are on the field.
Result<GameState> newGame(WorldState& world, const Snapshot& now);

/// Each robot of the two teams that has none gets a slot, while there are any.
void giveSlots(std::span<const RobotIdentity> robots, GameState& game);

/// Refuses rules that cannot be played by: InvalidArgument, with the key as the context.
Result<void> validate(const RefereeRules& rules);
/// Whether a saved game is one (damaged files).
bool isPlausible(const GameState& game, std::size_t robots);

/// A call by hand or by a program. Refused with the reason when the state of the game does not
/// allow it; nothing has changed then. `world.game` is there.
Result<void> callReferee(WorldState& world, const Snapshot& now, const RefereeCall& call,
                         Placements& placements, std::vector<Event>& events);

/// One tick of a match with a referee, after bodies have moved. `events` has those of the physics,
/// and gets those of the game. `world.game` is there.
void stepReferee(WorldState& world, const Snapshot& now, const BallSweep& way,
                 Placements& placements, std::vector<Event>& events);

/// The teams defend the other goals, and their robots are told so; nobody is moved. world.game is
/// there.
void swapSides(WorldState& world);

/// Ticks as people read a clock: whole seconds, rounded up.
int secondsOf(int ticks, double tickRate);

}  // namespace pitchboard::sim
