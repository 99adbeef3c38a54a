// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What rows of outcomes say together. Pure functions; any thread.

#include <cstddef>
#include <span>
#include <vector>

#include <robotlink/rollout/rollouts.h>

namespace pitchboard::rollout {

/// A share with its 95 % confidence interval (Wilson).
struct Share {
  double value = 0.0, low = 0.0, high = 1.0;
};

/// Of `hits` in `count` trials.
Share shareOf(double hits, double count);

struct Summary {
  std::size_t rollouts = 0;
  Share goalLeft, goalRight;    ///< of rollouts in which this side scored
  double goalDifference = 0.0;  ///< mean, left minus right
  double timeToGoal = 0.0;      ///< s, mean of those with a goal; NaN without
  Point ball;                   ///< mean place at the end
  double ballSigmaX = 0.0, ballSigmaY = 0.0;
};

/// Rows that were not played (NaN) are left out.
Summary summaryOf(std::span<const double> outcomes);

/// How often the ball lay in each cell at PlayOptions::look: rows from below, `columnsX` cells from
/// left to right in each; shares of 1. A ball outside the lines counts in the nearest cell.
std::vector<double> heatMap(std::span<const double> outcomes, const sim::FieldSpec& field,
                            int columnsX, int rowsY);

}  // namespace pitchboard::rollout
