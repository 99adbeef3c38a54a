// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot can do, as small pieces that behaviours put together. A skill looks at the world
// model and answers with one action; none of them touches the blackboard. Metres, radians.

#include <optional>
#include <vector>

#include <robotlink/cognition/path_planner.h>

#include "soccer/world_model.h"

namespace pitchboard::link {

/// DECISION_ACTION_A and _B.
struct Act {
  int action = 0;
  int b = 0;
  bool operator==(const Act&) const = default;
};

namespace acts {
inline constexpr Act stop{0, 0}, forward{1, 0}, turnLeft{2, 0}, turnRight{3, 0}, kickRight{4, 0},
    kickLeft{5, 0}, sidleLeft{6, 0}, sidleRight{7, 0}, forwardSlow{8, 10}, aroundLeft{9, 0},
    gait{11, 0}, aroundRight{14, 0}, backward{17, 0}, backwardSlow{18, 0};
}

/// Walks to a pose round everything that is known to stand in the way; plans five times a second.
/// Chooses among walking forward, sideways and backward the gait that gets it there first, turns
/// included: this body turns slowly (18 degrees a second).
class Walk {
 public:
  explicit Walk(const sim::FieldSpec& field)
      : m_planner(field.halfLength() + field.border - field.robotRadius,
                  field.halfWidth() + field.border - field.robotRadius) {}

  struct Goal {
    Pose pose;
    double near = 0.10;     ///< m, close enough
    double facing = 0.20;   ///< rad, turned well enough
    bool roundBall = true;  ///< keeps clear of the ball
  };
  /// Nothing when the robot is there.
  std::optional<Act> step(const WorldModel& world, const Goal& goal);
  /// The path in use, from the next bend on; turned like the world model. Old when nobody walked
  /// since `lastStep()`.
  const Path& path() const { return m_path; }
  /// When step() led somewhere last, s.
  double lastStep() const { return m_stepped; }

 private:
  void plan(const WorldModel& world, const Goal& goal);
  PathPlanner m_planner;
  std::vector<Obstacle> m_obstacles;
  Path m_path;
  double m_planned = -1e9, m_stepped = -1e9;
  Point m_plannedFor;
  int m_gait = -1;
  bool m_turning = false;
};

/// Looks for the ball: with the head (which vision turns), then turning, then walking to places
/// where it may lie.
class Search {
 public:
  Act step(const WorldModel& world, Walk& walk);
  void restart() { m_since.reset(); }

 private:
  std::optional<double> m_since;
};

/// Brings the ball towards a point: approaches a place behind it, turns round it until the robot
/// looks where the ball is to go, walks up to it (which dribbles it) and kicks with the foot on the
/// ball's side. Never kicks towards its own goal.
class Attack {
 public:
  Act step(const WorldModel& world, Walk& walk, const Point& aim);

 private:
  Act atBall(const WorldModel& world, double error, double tolerance);
  bool m_engaged = false;
  bool m_aligned = false;
};

/// Where the ball should go: the part of the goal that seen opponents cover least; out to the side
/// while it lies in front of the own goal.
Point aimFrom(const WorldModel& world, const Point& ball);

/// A team-mate that reaches this ball first, so that it is left to it. `advantage` (m) is what this
/// robot's way counts less.
bool mateIsFirst(const WorldModel& world, const Point& ball, double advantage);

}  // namespace pitchboard::link
