// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's advisor thinks, as it is shown: read from the ADVISOR_ variables of its
// blackboard, whatever the source. Plain values in metres and seconds, in the studio's frame; any
// thread.

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <base/geometry.h>

namespace pitchboard::link {

/// Where the ball may be: shares of all rollouts (or of the largest cell) in cells of the field.
struct BallHeat {
  int columns = 0, rows = 0;
  std::vector<float> cells;  ///< rows from below, cells from left to right
  bool operator==(const BallHeat&) const = default;
};

}  // namespace pitchboard::link
