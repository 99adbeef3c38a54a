// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How wrong a robot is about where it stands, instead of the thousands of particles that find out:
// an error for each axis and for the heading that wanders as the gait slips, and is drawn back as
// landmarks are seen. How quickly follows from what the filter assumes of its gait and senses (the
// steady state of a filter of one number), how far from what they really do. Metres, radians,
// seconds; pure.

#include <algorithm>
#include <cmath>

#include <simcore/world/noise.h>

namespace pitchboard::rollout {

struct Wander {
  double gain = 0.0;         ///< per second: share of the error that landmarks take away
  double resting = 0.0;      ///< its growth at rest, per root of a second
  double moving = 0.0;       ///< and in motion
  double filterSigma = 0.0;  ///< standard deviation that the filter believes in

  /// The error one step of `dt` later; `normal` is a standard normal draw.
  double step(double error, double dt, bool inMotion, double normal) const {
    const double kept = std::max(0.0, 1.0 - gain * dt);
    return kept * error + (inMotion ? moving : resting) * std::sqrt(dt) * normal;
  }
};

struct BeliefNoise {
  Wander place, yaw;
};

inline BeliefNoise beliefNoise(const sim::NoiseParameters& noise) {
  // What the filter assumes of corners (LocalizationParameters) and how often it looks. Its gains
  // and the factors are fitted to the filter's errors in matches of three against three of kid-size
  // robots with realistic noise: 0.09 m on an axis and 1.5 degrees, forgotten in 15 s and 2 s, and
  // told as 0.16 m (rollout_agreement prints the errors).
  constexpr double walkSigma = 0.01, turnSigma = 0.013, bearingSigma = 0.105;
  constexpr double placeFactor = 2.7, yawFactor = 1.2, filterFactor = 4.2;
  constexpr double looksPerSecond = 20.0, corner = 4.0;  // m to a corner
  constexpr double cornersOfPlace = 1.0, cornersOfYaw = 2.0;
  constexpr double framesPerSecond = 60.0;
  const double seen = std::max(0.02, noise.landmarkProbability) * looksPerSecond;
  const auto wander = [&](double assumed, double arm, double corners, double slip, double factor) {
    const double believed = bearingSigma * arm, real = noise.landmarkBearing * arm;
    const double filterR = believed * believed / (seen * corners);
    const double realR = real * real / (seen * corners);
    Wander out;
    out.gain = assumed / std::sqrt(filterR);
    out.filterSigma = filterFactor * std::sqrt(assumed * std::sqrt(filterR));
    const double measured = out.gain * out.gain * realR;  // of the landmarks' own errors
    out.resting = factor * std::sqrt(measured);
    out.moving = factor * std::sqrt(measured + slip * slip * framesPerSecond);
    return out;
  };
  return {wander(walkSigma, corner, cornersOfPlace, std::hypot(noise.forward, noise.sideways),
                 placeFactor),
          wander(turnSigma, 1.0, cornersOfYaw, noise.rotation, yawFactor)};
}

}  // namespace pitchboard::rollout
