// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a tick looks like from outside, whatever the physics model: a value in the studio's frame
// for the field view, the cards and the command line.

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
  int action = 0;        ///< the code that control carries out
  bool fallen = false;
  bool gettingUp = false;  ///< fallen, but rising
  // Of its kind of robot; where nobody knows it, those of the published one.
  double radius = 0.0;                      ///< m; 0 = the field's robot radius
  double fieldOfView = 1.2217304763960306;  ///< rad in all
  double visionRange = 3.0;                 ///< m
  RobotStatistics statistics;
  bool operator==(const RobotSnapshot&) const = default;
};

/// All but the robots.
struct GameSnapshot {
  std::uint64_t tick = 0;
  double time = 0.0;   ///< s simulated
  double clock = 0.0;  ///< s of play
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
