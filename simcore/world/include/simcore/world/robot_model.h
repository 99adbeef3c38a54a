// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A model of a robot as data: how fast it walks, how it kicks, its size and mass, what its camera
// sees, and the errors of all that. Every robot of a match has its own copy, which can be changed
// alone. The defaults are the published simulator's robot; other models are data:
// resources/robots/*.json (docs/scenarios.md). The `published` physics ignores it. Metres, radians,
// seconds; plain values; any thread.

#include <cstdint>
#include <string>

#include <base/result.h>
#include <simcore/world/noise.h>

namespace pitchboard::sim {

enum class KickLaw : std::uint8_t {
  Published,  ///< the published force, which fades within centimetres (<simcore/world/action.h>)
  Foot        ///< a foot hits a ball that lies within its reach and sector
};

struct RobotModel {
  std::string name = "published";

  // The gait. A speed is that of the action; turns are left positive.
  double forwardFast = 0.18;               ///< m/s, action 1
  double forwardSlow = 0.09;               ///< m/s, action 8 with DECISION_ACTION_B of 10 or more
  double backwardFast = 0.18;              ///< m/s, action 17
  double backwardSlow = 0.09;              ///< m/s, action 18
  double sideways = 0.12;                  ///< m/s, actions 6 and 7
  double turn = 0.3141592653589793;        ///< rad/s, actions 2 and 3: 18°/s
  double aroundSideways = 0.09;            ///< m/s, actions 9 and 14
  double aroundTurn = 0.3141592653589793;  ///< rad/s, actions 9 and 14
  double maxAcceleration = 1.0;            ///< m/s², forward and sideways
  double maxYawAcceleration = 6.0;         ///< rad/s²

  // The kick. All but the times belong to KickLaw::Foot.
  KickLaw kickLaw = KickLaw::Published;
  double kickSpeed = 1.5;       ///< m/s of a ball that the foot hits squarely, actions 4 and 5
  double weakKickSpeed = 0.75;  ///< m/s, actions 21 and 22
  double passSpeed = 1.0;       ///< m/s, actions 12 and 13
  double kickReach = 0.25;      ///< m from the robot's centre to that of a ball that it can hit
  double kickOuter = 0.7;       ///< rad from the heading to the kicking foot's own side ...
  double kickInner = 0.17;      ///< ... and to the other side; passes: kickOuter to both
  double footSide = 0.04;       ///< m from the middle of the robot to the middle of a foot
  double footWidth = 0.1;       ///< m beside the foot at which the ball gets exp(-1/2) of the speed
  double kickTime = 0.0;        ///< s during which the robot is busy kicking
  double kickContact = 0.0;     ///< s from the beginning to the moment in which it hits the ball

  // The body.
  double radius = 0.0;       ///< m, seen from above; 0 = the field's robot radius
  double mass = 4.0;         ///< kg
  double fallImpulse = 0.8;  ///< N·s in one tick that throws it down
  double getUpFront = 3.0;   ///< s
  double getUpBack = 3.0;    ///< s

  // The battery: below `batteryLow` a robot's battery counts as low. Does not affect the match.
  double batteryFull = 19.15;   ///< V
  double batteryLow = 16.0;     ///< V
  double batteryEmpty = 14.65;  ///< V

  // Head and camera.
  double headSpeed = 1.0471975511965976;    ///< rad/s, 1° per 1/60 s as published
  double panLimit = 2.356194490192345;      ///< rad to either side, ±135°
  double fieldOfView = 1.2217304763960306;  ///< rad, 70° in all
  double visionRange = 3.0;                 ///< m
  double cameraForward = 0.0;               ///< m in front of the robot's centre
  double cameraHeight = 0.45;               ///< m
  bool fromCamera = false;  ///< distances are straight lines from the lens, else along the ground
                            ///< from the robot's centre

  NoiseParameters noise;  ///< used if the match sets NoiseParameters::ofModel
  bool operator==(const RobotModel&) const = default;
};

/// What the gait does for an action.
struct GaitSpeed {
  double forward = 0.0;   ///< m/s
  double left = 0.0;      ///< m/s
  double turn = 0.0;      ///< rad/s
  bool inMotion = false;  ///< the legs move, also in place
};

/// Returns the speed of the gait for `action` (CONTROL_ACTION) with the parameter `b`
/// (DECISION_ACTION_B); no motion for an unknown action.
GaitSpeed gaitSpeed(const RobotModel& model, int action, int b);

/// Where a ball lies, as seen from the robot.
struct BallAtFeet {
  double distance = 0.0;  ///< m, between the centres
  double bearing = 0.0;   ///< rad, left positive
};

/// Returns the speed that a kick gives the ball, in m/s, without noise. 0 if the kick does not
/// reach it or `action` is no kick. `radius` is that of this robot, m.
double kickSpeed(const RobotModel& model, double radius, int action, const BallAtFeet& ball);

/// Returns the voltage that a simulated robot measures, in tenths of a volt. It is constant, at the
/// level of the published simulator: 18.9 V for its robot.
int simulatedVoltage(const RobotModel& model);

/// Fails with InvalidArgument for a number that is not finite or out of range; the context is
/// the key ("robot_model.mass").
Result<void> validate(const RobotModel& model);

}  // namespace pitchboard::sim
