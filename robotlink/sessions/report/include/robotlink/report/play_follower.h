// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds passes, shots, ball wins, set plays and penalties in the moments of a match, for a
// MatchTally. It needs the places of ball and robots; where robots do not tell that they kick, the
// ball's motion does. docs/statistics.md has the definitions. Plain values in metres and seconds;
// one thread at a time.

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <robotlink/report/play_event.h>
#include <robotlink/report/tally_moment.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

class PlayFollower {
 public:
  explicit PlayFollower(const sim::FieldSpec& field = {}) : m_field(field) {}
  /// `kicked`: who has kicked since the last moment. `isBefore`: the counted range begins later.
  void take(const TallyMoment& moment, std::span<const RobotUid> kicked, bool isBefore);
  /// In order of time; what is not over yet goes on.
  std::vector<PlayEvent> events() const;
  const std::vector<GoalScene>& goals() const { return m_goals; }

 private:
  struct Who {
    RobotUid uid;
    std::string name;
    TeamColor team = TeamColor::Blue;
  };
  /// A ball that was kicked, until somebody else gets it.
  struct Kick {
    Who who;
    double time = 0.0, lastTime = 0.0;
    Point from, last;    // last: the ball's place at lastTime, while it still rolled freely
    double reach = 0.0;  // m from `from`: as far as it would roll
    double sigma = 0.0;
  };
  struct Control {
    Who who;
    double since = 0.0;
    Point place;
  };
  struct Restart {
    TallyRestart what;
    std::size_t event = 0;
    std::optional<double> taken;  // s, when the ball was in play
    bool hasShot = false;
  };
  struct Sample {
    double time = 0.0;
    std::optional<Point> ball;
    std::vector<std::pair<RobotUid, Point>> robots;
  };
  static Who whoOf(const TallyRobot& robot) { return {robot.uid, robot.name, robot.team}; }
  void followBall(const TallyMoment& moment, std::span<const RobotUid> kicked);
  bool isOut(const Point& last, const Point& ball, double step) const;
  /// m between the robot and the ball.
  double gapOf(const TallyRobot& robot, const Point& ball) const;
  const TallyRobot* toucherOf(const TallyMoment& moment) const;
  const TallyRobot* kickerByMotion(const TallyMoment& moment) const;
  void startKick(const TallyMoment& moment, const TallyRobot& robot);
  void takeHiddenKick(const TallyMoment& moment, const TallyRobot& robot, const Point& from);
  void followKick(const TallyMoment& moment, const TallyRobot* toucher);
  void endKick(const TallyMoment& moment, const TallyRobot* toucher);
  std::optional<PlayOutcome> shotOf(const Kick& kick) const;
  void followControl(const TallyMoment& moment);
  void followRestart(const TallyMoment& moment);
  void endRestart(double time, PlayOutcome outcome);
  void followGoals(const TallyMoment& moment);
  void addScene(const TallyMoment& moment, const PlayEvent& goal, double played);
  void followPenalties(const TallyMoment& moment);
  void keepSample(const TallyMoment& moment);
  void add(PlayEvent event);

  sim::FieldSpec m_field;
  std::vector<PlayEvent> m_events;
  std::vector<GoalScene> m_goals;
  std::deque<Sample> m_recent;  // of the last seconds, oldest first
  std::optional<Kick> m_kick;
  std::optional<Control> m_holder, m_rival;  // rival: of the other team, not yet for long
  std::optional<Who> m_lastTouch;
  std::optional<Restart> m_restart;
  std::map<TeamColor, int> m_scores;
  std::map<TeamColor, bool> m_attacksRight;
  std::map<RobotUid, std::optional<std::size_t>> m_penalties;  // events of penalties that go on
  Velocity m_velocity;  // of the ball, between the last two moments
  bool m_isBefore = false;
};

}  // namespace pitchboard::link
