// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The text datagrams that robots broadcast about once a second (system.md section 7):
// n X Y THETA BELIEF BALL_DIST BALL_ANGLE CONTROL VISION LOCALIZATION DECISION IMU ACTION_A
// IMU_EULER_Z VOLTAGE OUT

#include <string>

namespace pitchboard::telemetry {

/// A published message, in the units on the wire: lengths in cm, angles in degrees (yaw in
/// radians), voltage in tenths of a volt.
struct TextMessage {
  int robot = 1;
  int x = 0, y = 0, theta = 0;  ///< LOCALIZATION_X, _Y, _THETA
  float belief = 0.0F;          ///< standard deviation of the particles, cm
  float ballDist = 0.0F, ballAngle = 0.0F;
  int control = 0, vision = 0, localization = 0, decision = 0, imu = 0;  ///< *_WORKING
  int actionA = 0;
  float imuEulerZ = 0.0F;
  int voltage = 0;
  bool operator==(const TextMessage&) const = default;
};

/// Returns exactly the bytes that the published process sends: single spaces, ints as decimal,
/// floats as Python 2's str() prints the float32 widened to double (12 significant digits), "OUT"
/// at the end, whatever the locale.
std::string encode(const TextMessage& message);

/// Returns a number as Python 2.7's str(float) writes it: %.12g, ".0" added to whole numbers,
/// exponents from 1e+11 on (%.12g alone: from 1e+12), "nan", "inf", "-inf".
std::string pythonFloat(double value);

}  // namespace pitchboard::telemetry
