// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes how a rolling ball slows down in a tick of any length. The rigid-body model and rollouts
// share these functions. Metres, seconds; pure functions; any thread.

#include <algorithm>

#include <base/repeatable_math.h>
#include <simcore/world/field.h>
#include <simcore/world/limits.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::sim {

/// The effect of Surface::keptPerFrame (Eq. (4) of the paper) in a tick of any length.
struct RollingShare {
  double kept = 1.0;  ///< share of its speed that the ball has left after the tick
  double mean = 1.0;  ///< mean speed over the tick, as a share of the speed before it
};

/// `share` is Surface::keptPerFrame, `dt` the length of the tick in s.
inline RollingShare rollingShare(double share, double dt) {
  RollingShare rolling;
  if (share >= 1.0) return rolling;
  // The published ball slows down before it moves, so it rolls v·f/60 + v·f²/60 + ... =
  // v·f/(60·(1 − f)) in all. Exponential decay that is scaled to this distance gives the same final
  // position at every tick rate, and at 60 Hz the same position after each tick.
  rolling.kept = repeatable::pow(share, dt * published_frame::framesPerSecond);
  const double distance = share / ((1.0 - share) * published_frame::framesPerSecond);
  rolling.mean = distance * (1.0 - rolling.kept) / dt;
  return rolling;
}

/// The speed of a ball that touches nothing, as shares of its speed before the tick.
struct Rolled {
  double mean = 0.0;  ///< mean over the tick
  double left = 0.0;  ///< at the end of the tick
};

/// `ballSpeed` is the speed before the tick in m/s, `dt` the length of the tick in s.
inline Rolled rolledOf(const Surface& surface, const RollingShare& rolling, double ballSpeed,
                       double dt) {
  const double speed = std::min(ballSpeed, fastestBall);
  // Grass slows the ball evenly over the tick, or over the part in which the ball still rolls.
  const double loss = surface.deceleration * dt;
  const double rolls = loss > speed ? speed / loss : 1.0;
  const double mean =
      speed > 0.0 ? (speed - 0.5 * loss * rolls) * rolls * rolling.mean / ballSpeed : 0.0;
  const double left = speed > 0.0 ? std::max(0.0, speed - loss) * rolling.kept / ballSpeed : 0.0;
  return {mean, left};
}

}  // namespace pitchboard::sim
