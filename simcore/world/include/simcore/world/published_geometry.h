// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field as the `published` model sees it: lines, posts, goals and limits in window centimetres.
// For the published field these are the whole numbers of docs/reference/published-exact.md; other
// fields give the same shapes with their own sizes. Plain values; any thread.

#include <array>

#include <simcore/world/field.h>

namespace pitchboard::sim {

/// A wall or net: from `from` to `to` along one axis, at `at` on the other.
struct PublishedLine {
  bool horizontal = true;
  double from = 0.0, to = 0.0, at = 0.0;
};

struct PublishedPoint {
  double x = 0.0, y = 0.0;
};

struct PublishedGeometry {
  explicit PublishedGeometry(const FieldSpec& field);

  std::array<PublishedLine, 8> lines;  ///< in the published order of tests
  std::array<PublishedPoint, 4> posts;
  std::array<PublishedPoint, 4> landmarks;  ///< blue, red, yellow, purple corner
  double left, right, top, bottom;          ///< limits of the field, on its lines
  double worldWidth, worldHeight;
  double goalDepth;  ///< from the goal line to the back of the goal
  double goalTop, goalBottom;
  double replaceMargin = 100.0;  ///< distance inside at which a ball that was out is put back
  double robotRadius, ballRadius, postRadius;
};

}  // namespace pitchboard::sim
