// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A shortest path for a robot among round things: robots, goal posts, the ball. Method: visibility
// graph (Lozano-Perez and Wesley, 1979) searched by A* (Hart, Nilsson and Raphael, 1968). Each
// circle stands for a regular polygon round it, whose corners are the places where a path may bend.
// Only circles that are in the way of some path so far get corners, so that a free line costs one
// test. Metres, the studio's frame. Scratch memory is the thread's. Any thread.

#include <span>

#include <base/geometry.h>
#include <base/inline_vector.h>

namespace pitchboard::link {

/// Something to keep away from. The radius includes the robot's own.
struct Obstacle {
  Point centre;
  double radius = 0.0;  ///< m; obstacles without a positive finite radius are ignored
};

struct Path {
  /// From the start to the target, both included; at least two points. Empty only when start or
  /// target are not finite. What of a longer way does not fit is planned when the robot is nearer.
  InlineVector<Point, 32> points;
  double length = 0.0;     ///< m
  bool targetFree = true;  ///< false: the target lay in an obstacle, its rim is the end
  bool complete = true;    ///< false: no way; the path ends where it comes nearest

  /// Where to walk to now: the first bend, or the target. Requires a path that is not empty.
  const Point& next() const { return points[1]; }
};

class PathPlanner {
 public:
  /// Paths stay within the rectangle |x| <= halfLength, |y| <= halfWidth (the walls), as far as
  /// start and target allow.
  PathPlanner(double halfLength, double halfWidth)
      : m_halfLength(halfLength), m_halfWidth(halfWidth) {}

  /// A start inside an obstacle (robots do touch) is no error: that obstacle shrinks until the
  /// start lies on its rim, so the path leads away. A target inside one moves to its rim. Without
  /// any way, the path leads to the reachable bend that is nearest to the target.
  Path plan(const Point& start, const Point& target, std::span<const Obstacle> obstacles) const;

 private:
  double m_halfLength, m_halfWidth;
};

}  // namespace pitchboard::link
