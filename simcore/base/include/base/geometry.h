// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Points, velocities and poses in the studio's frame: metres, radians, seconds; origin at the
// centre of the field, +x towards the right goal, +y up on the screen, yaw counter-clockwise from
// +x (CONVENTIONS.md). Plain values and pure functions; any thread.

#include <base/repeatable_math.h>

namespace pitchboard {

/// A point on the field, in metres.
struct Point {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Point&) const = default;
};

/// A velocity in the field's frame, in m/s.
struct Velocity {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Velocity&) const = default;
};

/// Returns the distance of `p` from the origin in metres.
inline double length(const Point& p) {
  return repeatable::hypot(p.x, p.y);
}

/// Returns the distance between two points in metres.
inline double distance(const Point& a, const Point& b) {
  return repeatable::hypot(a.x - b.x, a.y - b.y);
}

/// Returns the direction from one point to another, in radians counter-clockwise from +x.
inline double direction(const Point& from, const Point& to) {
  return repeatable::atan2(to.y - from.y, to.x - from.x);
}

/// A position and the direction that something faces.
struct Pose {
  Point position;
  double yaw = 0.0;  ///< radians
  bool operator==(const Pose&) const = default;
};

}  // namespace pitchboard
