// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Angles in radians, counter-clockwise positive, except in the published frame. Pure functions.

#include <cmath>
#include <numbers>

namespace pitchboard {

constexpr double radiansFromDegrees(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
constexpr double degreesFromRadians(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// Returns the same direction in (−π, π].
inline double wrapToPi(double radians) {
  constexpr double pi = std::numbers::pi;
  if (radians > -pi && radians <= pi) return radians;
  // Up to a turn and a half the difference is exact, so these are the remainder's bits in a tenth
  // of its time.
  constexpr double turnAndMore = 9.0;
  const double rest = radians > pi && radians < turnAndMore ? radians - 2.0 * pi
                      : radians <= -pi && radians > -turnAndMore
                          ? -(-radians - 2.0 * pi)
                          : std::remainder(radians, 2.0 * pi);
  return rest <= -pi ? pi : rest;
}

}  // namespace pitchboard
