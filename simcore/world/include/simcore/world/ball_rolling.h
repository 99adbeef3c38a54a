// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a ball slows down within a tick, whatever its length, which the rigid-body model and rollouts
// have in common. m, s, m/s; pure functions, any thread.

#include <algorithm>

#include <base/repeatable_math.h>
#include <simcore/world/field.h>
#include <simcore/world/limits.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::sim {

/// What the share of Surface::keptPerFrame (Eq. (4) of the paper) does in a tick, whatever the
/// rate.
struct RollingShare {
  double kept = 1.0;  ///< share of its speed that the ball has left after the tick
  double mean = 1.0;  ///< mean speed over the tick, as a share of the speed before it
};

inline RollingShare rollingShare(double share, double dt) {
  RollingShare rolling;
  if (share >= 1.0) return rolling;
  // The published ball slows, then moves: v·f/60 + v·f²/60 + ... = v·f/(60·(1 − f)). Scaled to this
  // whole way, exponential decay gives the same place at every tick rate, and at 60 Hz each tick's.
  rolling.kept = repeatable::pow(share, dt * published_frame::framesPerSecond);
  const double way = share / ((1.0 - share) * published_frame::framesPerSecond);
  rolling.mean = way * (1.0 - rolling.kept) / dt;
  return rolling;
}

/// Of a ball that nothing touches: its mean speed over the tick and what it has left at its end, as
/// shares of `ballSpeed`, that before it.
struct Rolled {
  double mean = 0.0, left = 0.0;
};

inline Rolled rolledOf(const Surface& surface, const RollingShare& rolling, double ballSpeed,
                       double dt) {
  const double speed = std::min(ballSpeed, fastestBall);
  // Grass takes its share evenly over the tick, or over the part in which the ball still rolls.
  const double loss = surface.deceleration * dt;
  const double rolls = loss > speed ? speed / loss : 1.0;
  const double mean =
      speed > 0.0 ? (speed - 0.5 * loss * rolls) * rolls * rolling.mean / ballSpeed : 0.0;
  const double left = speed > 0.0 ? std::max(0.0, speed - loss) * rolling.kept / ballSpeed : 0.0;
  return {mean, left};
}

}  // namespace pitchboard::sim
