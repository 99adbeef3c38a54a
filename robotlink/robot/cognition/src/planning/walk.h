// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Walks to a target round everything that is known to stand in the way.
// Chooses among walking forward, sideways and backward the gait that gets it there first, turns
// included: this body turns slowly (18 degrees a second). Studio frame; metres, radians, seconds.
// Use from one thread.

#include <optional>

#include <robotlink/cognition/path_planner.h>
#include <robotlink/cognition/soccer_input.h>
#include <simcore/world/field.h>
#include <simcore/world/robot_model.h>

#include <robotlink/cognition/act.h>
#include "planning/target.h"

namespace pitchboard::link {

/// What a walk takes place in, of one moment.
struct Surroundings {
  double now = 0.0;  ///< s
  Pose pose;         ///< of this robot, as it believes
  Points robots;     ///< all others that it knows of
};

class Walk {
 public:
  static constexpr double defaultPlanPeriod = 0.2;  ///< s between two plans

  /// `field` has this robot's radius; of the others it knows that of their league.
  Walk(const sim::FieldSpec& field, double othersRadius, const sim::RobotModel& body,
       double planPeriod = defaultPlanPeriod)
      : m_field(field),
        m_othersRadius(othersRadius),
        m_body(body),
        m_planPeriod(planPeriod),
        m_planner(field.halfLength() + field.border - field.robotRadius,
                  field.halfWidth() + field.border - field.robotRadius) {}

  /// Nothing when the robot is there.
  std::optional<Act> step(const Surroundings& world, const Target& target);
  /// Nobody walks: the next target begins again.
  void rest();
  /// The path in use, from the next bend on; no points while nobody walks.
  const Path& path() const { return m_path; }

 private:
  void plan(const Surroundings& world, const Target& target);
  Act gaitTowards(const Surroundings& world, const Target& target, double left);

  sim::FieldSpec m_field;
  double m_othersRadius;
  sim::RobotModel m_body;
  double m_planPeriod;
  PathPlanner m_planner;
  Path m_path;
  double m_planned = -1e9;
  Point m_plannedFor;
  int m_gait = -1;
  bool m_turning = false;
};

}  // namespace pitchboard::link
