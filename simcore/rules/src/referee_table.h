// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee at work on one tick or one call: the state of the game and everything its parts need.
// Made again each time; keeps nothing. referee_calls.cpp has the calls, referee_states.cpp the
// machine of states, referee_restarts.cpp goals and set plays, referee_penalties.cpp penalties,
// referee_judge.cpp what the automatic referee sees, game_start.cpp how a game goes on. Metres,
// radians, ticks.

#include <cmath>

#include <simcore/rules/check_call.h>
#include <simcore/rules/game_start.h>
#include <simcore/rules/referee.h>
#include <simcore/world/world_state.h>

#include "ball_crossing.h"

namespace pitchboard::sim {

class RefereeTable {
 public:
  RefereeTable(WorldState& world, const Snapshot& now, Placements& placements,
               std::vector<Event>& events)
      : m_world(world),
        m_game(*world.game),
        m_memory(world.refereeMemory),
        m_rules(*world.settings.referee),
        m_conduct(conductOf(m_rules.style)),
        m_field(world.settings.field),
        m_now(now),
        m_placements(placements),
        m_events(events) {
    giveSlots(world.robots, m_game);
  }

  /// One that checkCall() allows.
  void carryOut(const RefereeCall& call);
  void tick(const BallSweep& sweep);
  /// game_start.cpp
  Result<void> start(const GameStart& start);

 private:
  // States.
  void carryOut(PlayState state);
  void enter(PlayState state);
  void beginReady(int kickOff);
  void beginPlaying();
  void finish();
  void nextHalf();
  void beginPhase(GamePhase phase);
  bool timeoutIsOver() const;
  void endTimeout();
  void changeSides();
  int kickingOff(int half) const;
  void runClocks();
  void whistle();
  void afterFinished();
  bool clockRuns() const;
  void mirror();

  // Goals and restarts.
  void goal(std::size_t team);
  void countGoal(std::size_t team, int goals);
  void beginSetPlay(SetPlay play, int team, const Point& place);
  void ballPlaced();
  void nextStep();
  void inPlay();
  void dropBall();
  void beginShot();
  void endShot();
  void freeBall(const Point& place);

  // Penalties.
  void penalise(std::size_t robot, PenaltyKind penalty);
  void pardon(std::size_t robot);
  void runPenalties();
  void putOutside(std::size_t robot);
  void pardonAll(int sinceTicks = 0);  ///< who has been penalised for so long
  int removalTicks(std::size_t robot, PenaltyKind penalty) const;
  void comesBack(std::size_t robot);

  // Judging.
  void judge(const BallSweep& sweep);
  void followTouches(const BallSweep& sweep);
  bool judgeLines(const BallSweep& sweep);
  void judgeGoal(bool right, const Point& where);
  void judgeRest();
  void judgeRobots();
  void judgeKickOff();
  void judgeGoalAreas();
  bool isInOwnGoalArea(std::size_t robot) const;
  bool isReturning(std::size_t robot) const;
  bool mayStandThere(std::size_t robot);  ///< at a kick-off or a penalty kick
  bool allStandReady();
  void judgeDoubleTouch(std::size_t robot);
  void judgePushing(std::size_t robot);
  void judgeSetPlay();
  void judgeHalf();
  void foul(std::size_t robot, PenaltyKind penalty);

  int ticks(double seconds) const {
    return static_cast<int>(std::lround(seconds * m_world.settings.tickRate));
  }
  void report(EventKind kind, int value = 0, RobotId robot = {}) {
    m_events.push_back({kind, m_world.tick, robot, value, m_cause});
  }
  bool plays(std::size_t robot) const;  ///< belongs to one of the two teams, is not penalised
  /// m; the published physics knows one robot only, that of the field.
  double radiusOf(std::size_t robot) const {
    return std::holds_alternative<PublishedState>(m_world.physics) ? m_field.robotRadius
                                                                   : robotRadius(m_world, robot);
  }
  int teamOf(std::size_t robot) const { return m_game.teamOf(m_world.robots[robot].team); }
  GamePlayer* player(std::size_t robot);
  const GamePlayer* player(std::size_t robot) const;
  /// +1: this team attacks towards +x.
  double attackSign(int team) const {
    return m_game.attacksRight(static_cast<std::size_t>(team)) ? 1.0 : -1.0;
  }
  Point place(std::size_t robot) const;  ///< where it is after what was placed in this tick
  Point ball() const { return m_placements.ball.value_or(m_now.ball); }
  void putBall(const Point& place);
  void putRobot(std::size_t robot, const Pose& pose) {
    m_placements.robots.push_back({robot, pose});
  }
  Point clamped(const Point& p, double inside) const;

  WorldState& m_world;
  Game& m_game;
  RefereeMemory& m_memory;
  const RefereeRules& m_rules;
  const RefereeConduct m_conduct;
  const FieldSpec& m_field;
  const Snapshot& m_now;
  Placements& m_placements;
  std::vector<Event>& m_events;
  std::uint32_t m_cause = 0;  // of the call that is carried out
};

/// Whether a robot with this penalty waits on the field.
inline bool staysOnField(PenaltyKind penalty) {
  return penalty == PenaltyKind::MotionInSet;
}

/// It plays again; cards stay.
inline void freeOfPenalty(GamePlayer& one) {
  one.penalty = PenaltyKind::None;
  one.counting = one.outside = false;
  one.ticksLeft = one.sinceTicks = 0;
}

inline double squared(const Point& a, const Point& b) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  return dx * dx + dy * dy;
}
inline bool within(const Point& a, const Point& b, double distance) {
  return squared(a, b) < distance * distance;
}

}  // namespace pitchboard::sim
