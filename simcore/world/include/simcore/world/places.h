// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks and corrects poses that come from a user, a file or a belief before a body is put there.
// Metres, radians. Pure functions; any thread.

#include <algorithm>
#include <cmath>

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::sim {

inline bool isFinite(const Pose& pose) {
  return std::isfinite(pose.position.x) && std::isfinite(pose.position.y) &&
         std::isfinite(pose.yaw);
}

/// Returns the position nearest to `point` at which a body of this radius is entirely inside the
/// walls.
inline Point insideWalls(const FieldSpec& field, const Point& point, double radius) {
  const double x = field.halfLength() + field.border - radius;
  const double y = field.halfWidth() + field.border - radius;
  return {std::clamp(point.x, -x, x), std::clamp(point.y, -y, y)};
}

}  // namespace pitchboard::sim
