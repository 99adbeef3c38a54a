// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is painted on the ground of a field, as shapes: everything that draws a field (the studio,
// its pictures, the experiments' trajectories) draws these. Metres; constant data.

#include <vector>

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::sim {

struct FieldLines {
  struct Box {
    Point low, high;  ///< the corners with the least and the greatest x and y
  };
  std::vector<Box> lines;     ///< to be filled
  std::vector<Box> goals;     ///< the ground of each goal, behind the goal line
  double circleRadius = 0.0;  ///< of the middle of the centre circle's line; 0 = no circle
  std::vector<Point> marks;   ///< the penalty marks; empty if the field has none
};

/// `lineWidth`: as it is drawn, which may be wider than the field's so that thin lines stay
/// visible. Sizes hold to the outer edges of the lines.
FieldLines fieldLines(const FieldSpec& field, double lineWidth);

}  // namespace pitchboard::sim
