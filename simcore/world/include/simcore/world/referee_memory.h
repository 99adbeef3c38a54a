// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the simulated referee remembers beside the game, for rules that need the past: nobody is
// told of it, and no packet has it. Part of WorldState. Times in ticks. Plain values; any thread.

#include <vector>

#include <base/game.h>
#include <base/geometry.h>

namespace pitchboard::sim {

/// Of a robot: for how long something has lasted.
struct RobotWatch {
  int downTicks = 0;     ///< fallen
  int outsideTicks = 0;  ///< outside the field
  int contactTicks = 0;  ///< pushing an opponent
  int immuneTicks = 0;   ///< time left in which it is not judged again
  Pose setPose;          ///< pose at the start of SET; in READY, where it has stood still
  int stillTicks = 0;    ///< standing still in READY
  int areaTicks = 0;     ///< in its own goal area
  int backTicks = -1;    ///< since it returned from a penalty; -1: long ago, or never
  bool operator==(const RobotWatch&) const = default;
};

/// A place that the ball has hardly left, and for how long.
struct BallRest {
  Point place;
  int ticks = 0;
  bool operator==(const BallRest&) const = default;
};

struct RefereeMemory {
  struct Touch {
    int robot = 0;  ///< id
    int team = Game::noTeam;
    int ticks = 0;  ///< since then; 0: the robot touches the ball now
    bool operator==(const Touch&) const = default;
  };

  Touch touch;                      ///< the last touch of the ball
  BallRest still;                   ///< for the rule about a ball that does not move
  BallRest near;                    ///< for the rule about a ball held up among robots
  int aloneTicks = 0;               ///< since a robot was near the ball
  bool obeyed = false;              ///< only a GameController's packets change the game
  std::vector<RobotWatch> watches;  ///< in the order of the robots
  bool operator==(const RefereeMemory&) const = default;
};

// The functions below visit the values of a game as state_values.h describes.

template <class Game, class Visitor>
void visitTeams(Game& g, Visitor& v) {
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  for (auto& t : g.teams) {
    all(t.number, t.colour, t.score, t.penaltyShots, t.singleShots, t.timeouts, t.penalties);
    for (auto& p : t.players) {
      all(p.penalty, p.counting, p.outside, p.ticksLeft, p.sinceTicks, p.warnings, p.yellow, p.red,
          p.cautions, p.goalkeeper);
    }
  }
}

template <class Memory, class Visitor>
void visitWatches(Memory& m, Visitor& v) {
  v.count(m.watches);
  for (auto& w : m.watches) {
    for (auto* value : {&w.downTicks, &w.outsideTicks, &w.contactTicks, &w.immuneTicks}) {
      v.value(*value);
    }
    for (auto* value : {&w.setPose.position.x, &w.setPose.position.y, &w.setPose.yaw}) {
      v.value(*value);
    }
  }
}

/// Visits what a game had up to version 5 of saved states.
template <class Game, class Memory, class Visitor>
void visitGameOfForm5(Game& g, Memory& m, Visitor& v) {
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  visitTeams(g, v);
  for (auto& t : g.teams) {
    for (auto& shirt : t.shirts) v.value(shirt);
  }
  all(g.swapped, g.state, g.phase, g.phaseBefore, g.half, g.firstKickOff, g.kickOff, g.restart.step,
      g.restart.kind, g.restart.team, g.restart.place.x, g.restart.place.y, g.restart.kicker,
      g.restart.passed, g.stopped, g.over, g.clock, g.clockUse, g.stateTicks, g.countdown.ticks,
      g.countdown.runs, g.hidden, g.breakLeft, g.dropIn.team, g.dropIn.ticks, m.touch.robot,
      m.touch.team, m.still.place.x, m.still.place.y, m.still.ticks, m.near.place.x, m.near.place.y,
      m.near.ticks, m.aloneTicks, g.shooter);
  visitWatches(m, v);
}

/// Visits everything.
template <class Game, class Memory, class Visitor>
void visitGame(Game& g, Memory& m, Visitor& v) {
  visitGameOfForm5(g, m, v);
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  for (auto& t : g.teams) {
    for (auto& goals : t.byHalf) v.value(goals);
  }
  for (auto& w : m.watches) all(w.stillTicks, w.areaTicks, w.backTicks);
  all(g.restart.onlyTaker, m.touch.ticks, m.obeyed);
}

}  // namespace pitchboard::sim
