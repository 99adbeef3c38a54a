// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a simulated robot's vision, control and IMU processes on its blackboard: reads exactly what
// they read, writes exactly what they write, and nothing that belongs to another process.

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/robot_io.h>

namespace pitchboard::link {

/// Stateless except for the map of variables, so one can serve many robots. Match thread only.
class BlackboardBridge {
 public:
  explicit BlackboardBridge(const RobotVariables& variables) : m_variables(variables) {}

  sim::RobotCommand read(const Blackboard& board) const;

  /// Writes in the published order: control and IMU, landmark vision, ball and robot vision. It
  /// clears a finished action only if that is still there, so that a newer one is never lost.
  /// `robots`: how many there are on the field.
  void publish(const sim::Percepts& percepts, Blackboard& board,
               std::size_t robots = sim::Percepts::maxSeenRobots) const;
  // publish() = publishBody() + publishSight(); conformance runs look at the blackboard in between.
  void publishBody(const sim::Percepts& percepts, Blackboard& board) const;
  void publishSight(const sim::Percepts& percepts, Blackboard& board,
                    std::size_t robots = sim::Percepts::maxSeenRobots) const;

 private:
  RobotVariables m_variables;
};

}  // namespace pitchboard::link
