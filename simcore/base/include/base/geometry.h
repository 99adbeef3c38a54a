// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain values of the studio's frame: metres, radians, seconds; origin at the centre of the field,
// +x towards the right goal, +y up on the screen, yaw counter-clockwise from +x (CONVENTIONS.md).

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

/// Where something stands and which way it faces.
struct Pose {
  Point position;
  double yaw = 0.0;  ///< radians
  bool operator==(const Pose&) const = default;
};

}  // namespace pitchboard
