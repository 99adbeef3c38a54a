// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The lines and marks on the ground of a field, as shapes. The studio, its pictures and the reports
// of experiments all draw these. Metres; pure function; any thread.

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
  double markRadius = 0.0;    ///< of these and the centre mark, if they are discs; 0 = crosses
  double arcRadius = 0.0;     ///< of the middle of a corner arc's line; 0 = no arcs
};

/// Returns the shapes of a field. `lineWidth` may be wider than that of the field, so that thin
/// lines stay visible; lengths are measured between outer edges of lines.
FieldLines fieldLines(const FieldSpec& field, double lineWidth);

}  // namespace pitchboard::sim
