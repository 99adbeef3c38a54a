// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How much of the noise of a gait is the robot's own, if it was also touched too weakly to be
// noticed. Private to calibrate. Any thread.

#include <algorithm>
#include <array>
#include <cmath>

#include "posterior_grid.h"

namespace pitchboard::link {

/// Posterior of the logarithm of the robot's own noise. `seen` is that of the logarithm of all
/// noise, own and of touches, which add up as independent ones do; `prior` and `sigma` are of the
/// own one. What touches add in a match is log-normal: it was found with robots whose noise is
/// known (calibration_proof 120 10001 match 300). Much noise is rather that of touches, and then
/// the recording hardly says how much is the robot's own.
inline PositivePosterior withoutTouches(const GridPosterior& seen, double prior, double sigma) {
  constexpr double median = 0.001, spread = 1.2;  // of the touches' noise, as noise.forward
  constexpr double normal95 = 1.959964;
  constexpr int nodes = 25;
  constexpr double reach = 3.0;  // deviations of the touches
  const double below = std::min((seen.median - seen.low) / normal95, 0.98 * sigma);
  const double above = std::min((seen.high - seen.median) / normal95, 0.98 * sigma);
  const auto logLikelihood = [&](double log) {
    const double off = (log - seen.median) / (log < seen.median ? below : above);
    const double fromPrior = (log - prior) / sigma;
    return 0.5 * (fromPrior * fromPrior - off * off);
  };
  PositivePosterior own = positivePosterior(std::exp(prior), sigma, [&](double noise) {
    std::array<double, nodes> logs;
    for (int i = 0; i < nodes; ++i) {
      const double z = reach * (2.0 * i / (nodes - 1) - 1.0);
      const double touches = median * std::exp(spread * z);
      logs[static_cast<std::size_t>(i)] =
          logLikelihood(std::log(std::hypot(noise, touches))) - 0.5 * z * z;
    }
    return logSumExp(logs);
  });
  for (double* one : {&own.median, &own.low, &own.high}) *one = std::log(*one);
  return own;
}

}  // namespace pitchboard::link
