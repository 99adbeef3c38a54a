// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How the ball rolled after one kick, from what the robot saw of it: at rest, then straight on with
// an even deceleration. Private to calibrate.

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "motion_fit.h"

namespace pitchboard::link {

constexpr double kickTick = 1.0 / 60.0;  // s

enum KickKind : std::size_t { StrongKick, WeakKick, PassKick, kickKinds };

KickKind kindOf(int code);

/// A ball's place relative to where the robot stood when the kick began (forward, left), as seen.
struct BallObservation {
  double time = 0.0;                 ///< s since the kick began, of the image
  double x = 0.0, y = 0.0;           ///< m
  double bearing = 0.0;              ///< rad, of the ray, in the same frame
  double radial = 1.0, round = 1.0;  ///< sigma along and across the ray, m
};

struct Kick {
  int code = 0;  ///< of the action (simcore/world/action_codes.h)
  std::vector<BallObservation> sights;
  double yawAtContact = 0.0;                  ///< rad, since the kick began
  double xAtContact = 0.0, yAtContact = 0.0;  ///< m, where the robot stood then
  // Fitted for a given deceleration:
  /// Where the ball lay (m), when it began to roll (s since the kick began), how fast (m/s).
  Eigen::Matrix<double, 5, 1> fitted = Eigen::Matrix<double, 5, 1>::Zero();
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
  double chi2 = 0.0;

  double speed() const { return std::hypot(fitted[3], fitted[4]); }
  double speedVariance() const {
    const Eigen::Vector2d along(fitted[3] / speed(), fitted[4] / speed());
    return along.dot(covariance.bottomRightCorner<2, 2>() * along);
  }
  double direction() const { return std::atan2(fitted[4], fitted[3]); }
  double directionVariance() const {
    const Eigen::Vector2d across(-fitted[4] / speed(), fitted[3] / speed());
    return across.dot(covariance.bottomRightCorner<2, 2>() * across) / (speed() * speed());
  }
};

/// The kick that begins in row `first`, with a first guess of its fit. Nothing unless the ball is
/// seen at rest before and rolling freely after it.
std::optional<Kick> kickAt(const CalibrationLog& log, const MotionFilter& filter,
                           const MotionFit::OfLog& fit, const MotionFit& motion, std::size_t first);

/// Fits its track by weighted least squares (Levenberg and Marquardt; Marquardt 1963), from what
/// was fitted before. `loss`: rolling deceleration, m/s^2.
void fitKick(Kick& kick, double loss);

/// The share of the full speed that the law of the foot gives for where the ball lay
/// (kickSpeed() of simcore/world).
double footShare(const sim::RobotModel& base, const Kick& kick);

}  // namespace pitchboard::link
