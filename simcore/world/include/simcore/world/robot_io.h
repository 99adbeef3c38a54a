// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulated robot's side of its blackboard: what control and vision read (RobotCommand), and
// what vision, control and IMU wrote in a tick (Percepts). Percepts have the units and signs of the
// blackboard (centimetres, degrees, left positive unless said otherwise), because the published
// model computes them so and they must arrive bit for bit. Plain values; any thread.

#include <array>
#include <optional>

namespace pitchboard::sim {

/// What is read from the blackboard before a tick: int variables.
struct RobotCommand {
  int actionA = 0;           ///< DECISION_ACTION_A
  int actionB = 0;           ///< DECISION_ACTION_B
  int searchOn = 1;          ///< DECISION_SEARCH_ON
  int actionVision = 0;      ///< DECISION_ACTION_VISION
  int localizationLook = 0;  ///< DECISION_LOCALIZATION
  int imuReset = 0;          ///< IMU_RESET
  bool operator==(const RobotCommand&) const = default;
};

struct ImuPercept {
  double eulerZ = 0.0;                           ///< rad, IMU_EULER_Z
  std::optional<std::array<double, 2>> eulerXY;  ///< rad, roll and pitch; absent in `published`
  std::optional<std::array<double, 3>> gyro;     ///< rad/s
  std::optional<std::array<double, 3>> accel;    ///< g
  std::optional<int> state;                      ///< IMU_STATE: 0 upright, 1 fallen
  bool resetDone = false;                        ///< true: clear IMU_RESET
};

struct ControlPercept {
  int action = 0;                     ///< CONTROL_ACTION
  std::optional<int> moving;          ///< CONTROL_MOVING, if it was written
  std::optional<int> finishedAction;  ///< action that is complete: DECISION_ACTION_A becomes 0
};

/// What landmark vision wrote. A value is absent if it was not looked for.
struct LandmarkPercept {
  std::optional<double> ballTiltDeg;  ///< VISION_TILT_DEG: ball distance in cm, −1 = not seen
  std::optional<double> ballPanDeg;   ///< VISION_PAN_DEG
  /// Blue, red, yellow, purple corner bearings in degrees, −999 = not seen.
  std::optional<std::array<double, 4>> bearingsDeg;
};

/// What ball vision wrote. An absent value leaves the blackboard unchanged.
struct BallPercept {
  std::optional<int> lost;           ///< VISION_LOST
  std::optional<double> distanceCm;  ///< VISION_BALL_DIST
  std::optional<double> angleDeg;    ///< VISION_BALL_ANGLE; not written by `published`
  std::optional<double> panDeg;      ///< VISION_PAN_DEG
};

/// VISION_RBTnn_*: robot nn is the nn-th robot of the field. The published map ends at 11.
struct SeenRobot {
  double distanceCm = 0.0;
  double angleDeg = 0.0;  ///< right positive: the published sign of this variable
};

struct Percepts {
  static constexpr int maxSeenRobots = 22;  ///< eleven against eleven

  ControlPercept control;
  ImuPercept imu;
  LandmarkPercept landmarks;
  BallPercept ball;
  std::array<std::optional<SeenRobot>, maxSeenRobots> robots;
  std::optional<int> searchOn;   ///< DECISION_SEARCH_ON, if vision changed it
  bool decisionWorking = false;  ///< `published` sets DECISION_WORKING, too
  int voltage = 189;             ///< VOLTAGE, tenths of a volt
};

}  // namespace pitchboard::sim
