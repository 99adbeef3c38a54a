// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// State of the `rigid-body` model: metres, radians, seconds in the studio's frame.

#include <array>
#include <cstdint>
#include <vector>

#include <base/geometry.h>

namespace pitchboard::sim {

/// Constants of the body that a scenario may change.
struct RigidBodySettings {
  double maxAcceleration = 1.0;             ///< m/s², of the gait, forward and sideways
  double maxYawAcceleration = 6.0;          ///< rad/s²
  double robotMass = 4.0;                   ///< kg
  double ballMass = 0.2;                    ///< kg
  double ballFriction = 0.95;               ///< share of its speed that the ball keeps in 1/60 s
  double postRestitution = 0.6;             ///< 0..1, ball against post, wall and net
  double robotRestitution = 0.3;            ///< 0..1, ball against robot
  bool falls = false;                       ///< robots can fall when hit hard
  double fallImpulse = 0.8;                 ///< N·s in one tick that throws a robot down
  double getUpTime = 3.0;                   ///< s
  double headSpeed = 1.0471975511965976;    ///< rad/s, 1° per 1/60 s as published
  double fieldOfView = 1.2217304763960306;  ///< rad, 70° in all
  double panLimit = 2.356194490192345;      ///< rad, ±135°
  double visionRange = 3.0;                 ///< m
  bool operator==(const RigidBodySettings&) const = default;
};

enum class Posture : std::uint8_t { Upright, OnFront, OnBack, GettingUp };

/// One look at the ball, kept until the vision delay has passed.
struct BallSighting {
  bool seen = false;
  double distance = 0.0;  ///< m
  double bearing = 0.0;   ///< rad from the body's heading, left positive
  bool operator==(const BallSighting&) const = default;
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
  double getUpRemaining = 0.0;          ///< s: lying, until it gets up; then until it stands
  double imuZero = 0.0;                 ///< rad, yaw at the last IMU reset
  double imuDrift = 0.0;                ///< rad, accumulated
  std::vector<BallSighting> sightings;  ///< ring over the vision delay; index tick % size
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
  bool operator==(const RigidBodyState&) const = default;
};

}  // namespace pitchboard::sim
