// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How the speed of a gait changes within a tick, and what counts as a bounce and as a push, which
// the rigid-body model and rollouts have in common. m/s or rad/s; pure functions, any thread.

#include <algorithm>
#include <cmath>

namespace pitchboard::sim {

/// The gait's speed after a tick in which it may change by `most`.
inline double approach(double value, double target, double most) {
  return value < target ? std::min(value + most, target) : std::max(value - most, target);
}

/// A speed of the gait after contacts changed it. Being slowed down is taken as it is; being pushed
/// faster or backwards is resisted by the feet, which lose `grip` of it in this tick.
inline double afterContact(double gait, double change, double grip) {
  const double speed = gait + change;
  const double own = std::clamp(speed, std::min(0.0, gait), std::max(0.0, gait));
  const double pushed = speed - own;
  return own + std::copysign(std::max(0.0, std::abs(pushed) - grip), pushed);
}

inline constexpr double feetGrip = 4.0;  ///< m/s², friction of about 0.4
/// Things that meet more slowly do not bounce: Box2D's threshold for units of 0.1 m. m/s.
inline constexpr double bouncesFrom = 0.1;
/// Share of its mass with which a robot pushes, and is pushed, at the height at which robots touch
/// each other: it tips about its feet instead of moving as a block. Of a uniform body touched at
/// 0.7 of its height h: (m·h²/3) / (0.7·h)². A ball touches it at its feet, with all of its mass.
inline constexpr double tippingShare = 0.68;

}  // namespace pitchboard::sim
