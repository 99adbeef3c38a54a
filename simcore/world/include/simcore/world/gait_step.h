// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes how the speed of a gait changes in a tick, and has the constants for bounces and pushes.
// The rigid-body model and rollouts share them. m/s or rad/s; pure functions; any thread.

#include <algorithm>
#include <cmath>

namespace pitchboard::sim {

/// Returns the speed after a tick in which it may change by at most `most`.
inline double approach(double value, double target, double most) {
  return value < target ? std::min(value + most, target) : std::max(value - most, target);
}

/// Returns the speed of the gait after contacts changed it by `change`. A change that slows the
/// robot down takes full effect. A push that makes it faster or moves it backwards is resisted by
/// its feet, which remove up to `grip` of it in this tick.
inline double afterContact(double gait, double change, double grip) {
  const double speed = gait + change;
  const double own = std::clamp(speed, std::min(0.0, gait), std::max(0.0, gait));
  const double pushed = speed - own;
  return own + std::copysign(std::max(0.0, std::abs(pushed) - grip), pushed);
}

inline constexpr double feetGrip = 4.0;  ///< m/s², friction of about 0.4
/// Bodies that meet more slowly (m/s) do not bounce: Box2D's threshold with units of 0.1 m.
inline constexpr double bouncesFrom = 0.1;
/// The effective mass of a robot when robots touch each other, as a share of its mass: it tips
/// about its feet instead of moving as a block. For a uniform body that is touched at 0.7 of its
/// height h this is (m·h²/3) / (0.7·h)². Against a ball, which touches the feet, the whole mass
/// counts.
inline constexpr double tippingShare = 0.68;

}  // namespace pitchboard::sim
