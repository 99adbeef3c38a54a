// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plans a shortest path for a robot among circular obstacles: robots, goal posts, the ball. The
// method is a visibility graph (Lozano-Perez and Wesley, 1979) searched by A* (Hart, Nilsson and
// Raphael, 1968). Each circle is replaced by a regular polygon around it, whose corners are the
// points where a path may bend. Corners are added only for circles that block a path found so far,
// so a free line costs a single test. Metres, the studio's frame. Any thread; working memory is
// thread-local.

#include <span>

#include <base/geometry.h>
#include <base/inline_vector.h>

namespace pitchboard::link {

/// An obstacle. Its radius includes that of the robot that walks.
struct Obstacle {
  Point centre;
  double radius = 0.0;  ///< m; ignored unless positive and finite
};

struct Path {
  /// From the start to the target, both included, so at least two points. Empty only if start or
  /// target are not finite. A path with more bends is cut off; plan again when the robot is closer.
  InlineVector<Point, 32> points;
  double length = 0.0;     ///< m
  bool targetFree = true;  ///< false: the target is inside an obstacle; the path ends at its rim
  bool complete = true;    ///< false: the target is out of reach; the path ends close to it

  /// Returns where to walk to first: the first bend, or the target. The path must not be empty.
  const Point& next() const { return points[1]; }
};

class PathPlanner {
 public:
  /// Paths stay inside the walls, the rectangle |x| <= halfLength, |y| <= halfWidth, unless start
  /// or target are outside.
  PathPlanner(double halfLength, double halfWidth)
      : m_halfLength(halfLength), m_halfWidth(halfWidth) {}

  /// If the start is inside an obstacle (robots do touch), the obstacle shrinks until the start is
  /// on its rim, so that the path leads away from it. If the target is inside an obstacle, it moves
  /// to the rim. If the target is out of reach, the path ends at the reachable bend closest to it.
  Path plan(const Point& start, const Point& target, std::span<const Obstacle> obstacles) const;

 private:
  double m_halfLength, m_halfWidth;
};

}  // namespace pitchboard::link
