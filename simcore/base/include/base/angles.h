// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Angles. Everywhere but in the published frame: radians, counter-clockwise positive.

#include <cmath>
#include <numbers>

namespace pitchboard {

constexpr double radiansFromDegrees(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
constexpr double degreesFromRadians(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// The same direction in (−π, π].
inline double wrapToPi(double radians) {
  const double wrapped = std::remainder(radians, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace pitchboard
