// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The state of the `rigid-body` model, in the studio's frame: metres, radians, seconds. Plain
// values; any thread.

#include <array>
#include <cstdint>
#include <vector>

#include <base/geometry.h>

namespace pitchboard::sim {

/// Constants of ball and contacts that a scenario may change. Those of a robot are in its
/// RobotModel, and how the ball rolls is in the field's Surface.
struct RigidBodySettings {
  double ballMass = 0.2;          ///< kg
  double postRestitution = 0.6;   ///< 0..1, ball against post, wall and net
  double robotRestitution = 0.3;  ///< 0..1, ball against robot
  bool falls = false;             ///< robots fall when they are hit hard
  bool operator==(const RigidBodySettings&) const = default;
};

enum class Posture : std::uint8_t { Upright, OnFront, OnBack, GettingUp };

/// A robot at a past moment.
struct PastRobot {
  bool there = false;  ///< it was on the field
  bool down = false;   ///< it had fallen and saw nothing
  Pose pose;
  double headYaw = 0.0;  ///< rad relative to the body
  bool operator==(const PastRobot&) const = default;
};

/// What could be seen at a past moment; kept until the vision delay has passed.
struct PastMoment {
  Point ball;
  std::vector<PastRobot> robots;  ///< one for each present robot
  bool operator==(const PastMoment&) const = default;
};

struct RigidRobot {
  Pose pose;
  double forwardSpeed = 0.0;   ///< m/s, along the heading
  double sidewaysSpeed = 0.0;  ///< m/s, to the left
  double yawRate = 0.0;        ///< rad/s
  Velocity velocity;           ///< m/s, true motion over the last tick in the field's frame
  double headYaw = 0.0;        ///< rad relative to the body, left positive
  bool panRight = true;        ///< direction of the search
  int action = 0;              ///< control's current action
  int actionB = 0;             ///< its parameter, read when the action was chosen
  bool inMotion = false;
  Posture posture = Posture::Upright;
  double getUpRemaining = 0.0;  ///< s until it has got up; 0 if it stands
  double kickElapsed = -1.0;    ///< s since the current kick began; negative if there is none
  double imuZero = 0.0;         ///< rad, yaw at the last IMU reset
  double imuDrift = 0.0;        ///< rad, accumulated
  bool operator==(const RigidRobot&) const = default;
};

struct RigidBall {
  Point position;
  Velocity velocity;  ///< m/s
  bool operator==(const RigidBall&) const = default;
};

struct RigidBodyState {
  std::vector<RigidRobot> robots;
  RigidBall ball;
  std::vector<PastMoment> past;  ///< ring buffer over the longest vision delay; index tick % size
  bool operator==(const RigidBodyState&) const = default;
};

}  // namespace pitchboard::sim
