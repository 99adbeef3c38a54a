// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain values of the studio's frame: metres, radians, seconds; origin at the centre of the field,
// +x towards the right goal, +y up on the screen, yaw counter-clockwise from +x (CONVENTIONS.md).
// And what is measured between them.

#include <base/repeatable_math.h>

namespace pitchboard {

/// A place on the field, metres.
struct Point {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Point&) const = default;
};

/// A velocity in the field's frame, m/s.
struct Velocity {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Velocity&) const = default;
};

/// From the origin to `p`, metres.
inline double length(const Point& p) {
  return repeatable::hypot(p.x, p.y);
}

/// Between two places, metres.
inline double distance(const Point& a, const Point& b) {
  return repeatable::hypot(a.x - b.x, a.y - b.y);
}

/// The way from one place to another, radians counter-clockwise from +x.
inline double direction(const Point& from, const Point& to) {
  return repeatable::atan2(to.y - from.y, to.x - from.x);
}

/// Where something stands and which way it faces.
struct Pose {
  Point position;
  double yaw = 0.0;  ///< radians
  bool operator==(const Pose&) const = default;
};

}  // namespace pitchboard
