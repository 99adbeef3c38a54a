// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot can do, as small pieces that behaviours put together. A skill looks at the world
// model and answers with one action, or with a target for planning; none of them touches the
// blackboard. Metres, radians. Use from one thread.

#include <memory>
#include <optional>
#include <variant>

#include <robotlink/cognition/act.h>
#include "planning/target.h"
#include "soccer/world_model.h"

namespace pitchboard::link {

/// One thing to do: an action, or a target that planning walks to, turned like the world model.
using Move = std::variant<Act, Target>;

enum class Ball { Ignore, KeepClear };

/// Nothing when the robot is there.
std::optional<Target> walkTo(const WorldModel& world, const Pose& pose, double near, double facing,
                             Ball ball);

/// Looks for the ball: with the head (which vision turns), then where it was seen last, then
/// turning and walking round the field from there.
class Search {
 public:
  explicit Search(const BehaviourParameters& numbers)
      : m_numbers(std::make_shared<const BehaviourParameters>(numbers)) {}
  Move step(const WorldModel& world);
  void restart() { m_since.reset(); }

 private:
  void begin(const WorldModel& world);
  Move walk(const WorldModel& world, double time);
  std::shared_ptr<const BehaviourParameters> m_numbers;  // of its copies, too
  std::optional<double> m_since;
  std::optional<Point> m_lost;  // where it was seen last, until this robot has been there
  double m_patience = 0.0;      // s, for the way there
  std::size_t m_first = 0;      // of the places, the nearest to that
};

/// Brings the ball towards a point: approaches a place behind it, turns round it until the robot
/// looks where the ball is to go, and walks on with it at its feet. Kicks when a kick is worth more
/// than that (kick_choice.h), never towards its own goal.
class Attack {
 public:
  explicit Attack(const BehaviourParameters& numbers)
      : m_numbers(std::make_shared<const BehaviourParameters>(numbers)) {}
  /// `clears`: the ball must go, wherever to.
  Move step(const WorldModel& world, const Point& aim, bool clears);

 private:
  double tolerance(const WorldModel& world, const Point& ball, double goalDistance) const;
  double kicksFrom(const WorldModel& world) const;
  Act atBall(const WorldModel& world, double error, double tolerance);
  std::optional<Act> kick(const WorldModel& world) const;
  double heldFor(const WorldModel& world, const Point& ball);
  std::shared_ptr<const BehaviourParameters> m_numbers;  // of its copies, too
  bool m_engaged = false;
  bool m_aligned = false;
  bool m_clears = false;
  double m_held = 0.0;        // s, how long the ball has not got away from here
  double m_heldSince = -1e9;  // s
  Point m_heldAt;
};

/// Where the ball should go: the part of the goal that seen opponents cover least; from farther
/// away past those who stand in the way; out to the side while it lies in front of the own goal.
/// `aimSide`: BehaviourParameters.
Point aimFrom(const WorldModel& world, const Point& ball, double aimSide);

}  // namespace pitchboard::link
