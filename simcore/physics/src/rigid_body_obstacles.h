// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What stands on and round the field: walls, goal posts, side nets and backs of the goals. Metres.

#include <array>

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::sim::rigid {

/// A round thing (first == last) or a stretch of wall or net of no thickness.
struct Obstacle {
  Point first;
  Point last;
  double radius = 0.0;
};

inline constexpr std::size_t wallCount = 4;
inline constexpr std::size_t obstacleCount = wallCount + 4 + 4 + 2;
/// The walls first (left, right, lower, upper), then posts, side nets and backs of the goals.
using Obstacles = std::array<Obstacle, obstacleCount>;

Obstacles obstaclesOf(const FieldSpec& field);

/// From the nearest point of an obstacle to `place`. For a wall the distance is that to its line,
/// negative outside, so that nothing that got behind a wall is pushed further out.
struct Clearance {
  double distance = 0.0;  ///< m, to the centre line of a net or the centre of a post
  Point direction;        ///< unit vector away from the obstacle
};
Clearance clearance(const Obstacles& obstacles, std::size_t index, const Point& place);

}  // namespace pitchboard::sim::rigid
