// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the ball may be some time after a moment. Made by the panel Explore, drawn by the field. An
// immutable value; any thread.

#include <memory>
#include <vector>

namespace pitchboard::ui {

/// In cells of the field. Only the ratios of the numbers count.
struct BallHeat {
  int columns = 0, rows = 0;
  std::vector<float> cells;  ///< rows from below, cells from left to right
};
using BallHeatPtr = std::shared_ptr<const BallHeat>;

}  // namespace pitchboard::ui
