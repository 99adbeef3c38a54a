// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_obstacles.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::sim::rigid {

Obstacles obstaclesOf(const FieldSpec& field) {
  const double x = field.halfLength() + field.border;
  const double y = field.halfWidth() + field.border;
  const double line = field.halfLength();
  const double back = line + field.goalDepth;
  const double post = field.goalWidth / 2.0;
  const double radius = field.goalPostRadius;
  return {{
      {{-x, -y}, {-x, y}, 0.0},
      {{x, -y}, {x, y}, 0.0},
      {{-x, -y}, {x, -y}, 0.0},
      {{-x, y}, {x, y}, 0.0},
      {{-line, post}, {-line, post}, radius},
      {{-line, -post}, {-line, -post}, radius},
      {{line, post}, {line, post}, radius},
      {{line, -post}, {line, -post}, radius},
      {{-back, post}, {-line, post}, 0.0},
      {{-back, -post}, {-line, -post}, 0.0},
      {{line, post}, {back, post}, 0.0},
      {{line, -post}, {back, -post}, 0.0},
      {{-back, -post}, {-back, post}, 0.0},
      {{back, -post}, {back, post}, 0.0},
  }};
}

Clearance clearance(const Obstacles& obstacles, std::size_t index, const Point& place) {
  const Obstacle& o = obstacles[index];
  switch (index) {
    case 0:
      return {place.x - o.first.x, {1.0, 0.0}};
    case 1:
      return {o.first.x - place.x, {-1.0, 0.0}};
    case 2:
      return {place.y - o.first.y, {0.0, 1.0}};
    case 3:
      return {o.first.y - place.y, {0.0, -1.0}};
    default:
      break;
  }
  // Posts are points and nets run along an axis, first to last upwards.
  const double dx = place.x - std::clamp(place.x, o.first.x, o.last.x);
  const double dy = place.y - std::clamp(place.y, o.first.y, o.last.y);
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (distance > 0.0) return {distance, {dx / distance, dy / distance}};
  // Exactly on it: towards the middle of the field, across a net.
  if (o.first.x < o.last.x) return {0.0, {0.0, place.y > 0.0 ? -1.0 : 1.0}};
  return {0.0, {place.x > 0.0 ? -1.0 : 1.0, 0.0}};
}

}  // namespace pitchboard::sim::rigid
