// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a place is one at all, and the nearest that bodies can have: for everything that is put
// somewhere by hand, by a file or by a belief. Metres, radians. Pure.

#include <algorithm>
#include <cmath>

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::sim {

inline bool isFinite(const Pose& pose) {
  return std::isfinite(pose.position.x) && std::isfinite(pose.position.y) &&
         std::isfinite(pose.yaw);
}

/// The nearest place at which a body of this radius lies wholly inside the walls.
inline Point insideWalls(const FieldSpec& field, const Point& point, double radius) {
  const double x = field.halfLength() + field.border - radius;
  const double y = field.halfWidth() + field.border - radius;
  return {std::clamp(point.x, -x, x), std::clamp(point.y, -y, y)};
}

}  // namespace pitchboard::sim
