// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Estimates all motion parameters (motion_parameters.h) together: the mode of the posterior by the
// method of scoring on the innovations of the filter, with the expected information
//   I_ij = sum(dv_i dv_j / S + 1/2 dS_i dS_j / S^2)
// (Harvey, Forecasting, Structural Time Series Models and the Kalman Filter, 1989, section 3.4.5),
// and the normal approximation of the posterior of the logarithms around it, mixed over the noise
// that is not known well. The delay between an image and its percepts is looked for on a grid of
// ticks of 1/60 s. Private to calibrate.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "motion_filter.h"
#include "motion_parameters.h"
#include "posterior_grid.h"

namespace pitchboard::link {

struct MotionFit {
  MotionLogs logs{};           ///< medians
  Eigen::MatrixXd covariance;  ///< of the posterior of the logarithms, at its mode
  MotionLogs information{};    ///< 1 - (posterior / prior)^2 of the deviation: 0 learned nothing
  std::array<GridPosterior, motionParameterCount> marginals;  ///< of the logarithms
  double delay = 0.0;                                         ///< s, whole ticks
  GridPosterior delayPosterior;      ///< of the number in the model, which is no whole tick
  std::vector<double> delayOfTicks;  ///< probability that the delay is 0, 1, 2… whole ticks
  bool delayKnown = false;
  sim::RobotModel model;  ///< the base with these values
  struct OfLog {
    std::vector<Innovation> innovations;
    std::vector<MotionState> states;
    FilterDecisions decisions;
  };
  std::vector<OfLog> ofLogs;
};

/// Tells the filters where the fitted robot is disturbed. No `ofLogs` if it was cancelled.
MotionFit fitMotion(std::span<MotionFilter> filters, std::span<const CalibrationLog> logs,
                    const sim::RobotModel& base, const std::function<bool(double)>& progress);

}  // namespace pitchboard::link
