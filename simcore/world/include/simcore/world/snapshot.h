// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What people see of a tick, whatever the physics model: a plain value in the studio's frame
// (metres, radians) for the field, the cards and the command line. Any thread.

#include <cstdint>
#include <vector>

#include <base/geometry.h>
#include <base/ids.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

struct RobotSnapshot {
  RobotIdentity identity;
  Pose pose;
  double headYaw = 0.0;  ///< rad, in the field's frame
  Velocity velocity;     ///< m/s
  int action = 0;        ///< code of the action that control executes
  bool fallen = false;
  bool gettingUp = false;  ///< it has fallen and is getting up
  // From its model; those of the published robot if the model is unknown.
  double radius = 0.0;                      ///< m; 0: the field's robot radius
  double fieldOfView = 1.2217304763960306;  ///< rad, total angle
  double visionRange = 3.0;                 ///< m
  RobotStatistics statistics;
  bool operator==(const RobotSnapshot&) const = default;
};

/// Everything except the robots.
struct GameSnapshot {
  std::uint64_t tick = 0;
  double time = 0.0;   ///< s of simulated time
  double clock = 0.0;  ///< s of the game clock
  bool clockRunning = false;
  Score score;
  Point ball;
  Velocity ballVelocity;  ///< m/s
  bool operator==(const GameSnapshot&) const = default;
};

struct Snapshot : GameSnapshot {
  std::vector<RobotSnapshot> robots;
  bool operator==(const Snapshot&) const = default;
};

}  // namespace pitchboard::sim
