// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Summarizes rows of outcomes. Pure functions; any thread.

#include <cstddef>
#include <span>
#include <vector>

#include <robotlink/rollout/rollouts.h>

namespace pitchboard::rollout {

/// A share of 1 with its 95 % confidence interval (Wilson).
struct Share {
  double value = 0.0, low = 0.0, high = 1.0;
};

/// Returns the share of `hits` in `count` trials.
Share shareOf(double hits, double count);

struct OutcomeSummary {
  std::size_t rollouts = 0;
  Share goalLeft, goalRight;    ///< rollouts in which the team on this side scored
  double goalDifference = 0.0;  ///< mean, left minus right
  double timeToGoal = 0.0;      ///< s, mean over rollouts with a goal; NaN if there is none
  Point ball;                   ///< mean position at the end
  double ballSigmaX = 0.0, ballSigmaY = 0.0;
};

/// Rows of rollouts that were not played (NaN) are ignored.
OutcomeSummary summaryOf(std::span<const double> outcomes);

/// Returns the cell of a heat map of the field in which a ball counts. Cells are numbered row by
/// row from the bottom, each row from left to right. A ball outside the lines counts in the
/// nearest.
std::size_t heatCell(const Point& ball, const sim::FieldSpec& field, int columns, int rows);

/// Returns in which share of rollouts the ball was in each cell (heatCell) at PlayOptions::look.
std::vector<double> heatMap(std::span<const double> outcomes, const sim::FieldSpec& field,
                            int columnsX, int rowsY);

}  // namespace pitchboard::rollout
