// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee of a simulated match has two parts: a state machine that follows calls, whoever makes
// them (a person, a program, or the referee itself), and an automatic referee that makes calls from
// what happens on the field. Both are pure functions of the world's state, which contains the game.
// They do not move bodies themselves: they return Placements, which the simulation carries out.
// Metres, radians, ticks. Any thread.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <base/game.h>
#include <base/result.h>
#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/field.h>
#include <simcore/world/referee_memory.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::sim {

enum class CallKind : std::uint8_t {
  State,     ///< uses state: the game goes to it
  KickOff,   ///< uses team: it kicks off next; noTeam means a drop ball
  Goal,      ///< uses team and value: +1 adds a goal, −1 takes one back
  SetPlay,   ///< uses team, setPlay and place
  NextStep,  ///< advances the set play by a step, at last to the ball being in play
  DropBall,  ///< goes to READY with the ball on the centre mark; neither team kicks off
  Penalise,  ///< uses robot and penalty
  Pardon,    ///< uses robot: its penalty ends
  Card,      ///< uses robot and value: 0 warning, 1 yellow, 2 red
  NextHalf,  ///< starts the next half; only after FINISHED
  ShootOut,  ///< starts a penalty shoot-out; only after FINISHED
  Timeout,   ///< uses team: it takes a timeout; noTeam means a referee timeout
  Stop,      ///< stops play
  GoOn,      ///< resumes play after Stop
  Automatic  ///< uses value: 1 turns the automatic referee on, 0 turns it off
};

/// A call by a person, a program or the automatic referee. CallKind says which members it uses.
struct RefereeCall {
  CallKind kind = CallKind::State;
  PlayState state = PlayState::Initial;
  int team = Game::noTeam;  ///< index of Game::teams
  RobotId robot{};
  SetPlay setPlay = SetPlay::None;
  PenaltyKind penalty = PenaltyKind::None;
  int value = 0;
  std::optional<Point> place{};
  std::uint32_t cause = 0;  ///< copied into the events that the call causes immediately
  bool operator==(const RefereeCall&) const = default;
};

/// Where the simulation has to put the ball and robots at the end of this tick.
struct Placements {
  std::optional<Point> ball;
  std::vector<std::pair<std::size_t, Pose>> robots;  ///< index of the robot, and its new pose
  void clear() {
    ball.reset();
    robots.clear();
  }
};

/// Returns the game before its first whistle. It is played by the teams in the world's settings, or
/// by the colours on the field if the settings name none. In each team, the robot that stands
/// nearest to its own goal in `now` is the goalkeeper. Sets the direction of attack of each robot
/// in `world`. Error InvalidArgument if robots of more than two teams are on the field.
Result<Game> newGame(WorldState& world, const Snapshot& now);

/// Error Conflict if the game is between two other teams.
Result<void> checkTeam(const Game& game, TeamColor team);

/// Gives a slot of GameTeam::players to each robot that has none, as long as slots are free.
void giveSlots(std::span<const RobotIdentity> robots, Game& game);

/// Returns where these rules put the ball for a set play of a team that attacks towards +x (`sign`
/// 1) or −x (−1), if the ball left the field or lay at `where`.
Point setPlayPlace(SetPlay play, double sign, const Point& where, RefereeStyle style,
                   const FieldSpec& field);

/// Error InvalidArgument, with the key as context, if no game can be played by these rules.
Result<void> validate(const RefereeRules& rules);
/// Returns false if the game has values that no game can have, such as one read from a damaged
/// file.
bool isPlausible(const Game& game, const RefereeMemory& memory, std::size_t robots);

/// Appends what a GameController's packet has changed in the game since `before`, as events of this
/// tick. In the first packet (`joins`) another score is a correction: nobody saw the goals.
void reportObeyed(const Game& before, bool joins, const WorldState& world,
                  std::vector<Event>& events);

/// Carries out a call of a person or program. If the state of the game does not allow it, returns
/// the error of checkCall() and changes nothing. world.game must exist.
Result<void> callReferee(WorldState& world, const Snapshot& now, const RefereeCall& call,
                         Placements& placements, std::vector<Event>& events);

/// Advances the game by a tick, after bodies have moved. `events` contains the events of the
/// physics in this tick; those of the game are appended. world.game must exist.
void stepReferee(WorldState& world, const Snapshot& now, const BallSweep& sweep,
                 Placements& placements, std::vector<Event>& events);

/// Swaps the goals that the two teams defend, and the directions in which their robots attack.
/// Robots and ball stay where they are. world.game must exist.
void swapSides(WorldState& world);

}  // namespace pitchboard::sim
