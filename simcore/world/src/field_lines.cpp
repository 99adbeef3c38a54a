// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/field_lines.h>

#include <algorithm>

namespace pitchboard::sim {

FieldLines fieldLines(const FieldSpec& field, double lineWidth) {
  FieldLines shapes;
  const double inset = lineWidth / 2;
  const double x = field.halfLength() - inset, y = field.halfWidth() - inset;
  const auto line = [&](const Point& from, const Point& to) {
    // Corners belong to the lines across.
    const double up = from.x == to.x ? 0.0 : inset;
    shapes.lines.push_back({{std::min(from.x, to.x) - inset, std::min(from.y, to.y) - up},
                            {std::max(from.x, to.x) + inset, std::max(from.y, to.y) + up}});
  };
  for (const double side : {-1.0, 1.0}) {
    line({-x, side * y}, {x, side * y});
    line({side * x, -y}, {side * x, y});
  }
  line({0, -y}, {0, y});
  const auto area = [&](double length, double width) {
    if (length <= 0 || width <= 0) return;
    const double halfWidth = std::min(width / 2 - inset, y);
    for (const double side : {-1.0, 1.0}) {
      const double inner = side * (x - length + inset);
      for (const double up : {-halfWidth, halfWidth}) line({side * x, up}, {inner, up});
      line({inner, -halfWidth}, {inner, halfWidth});
    }
  };
  area(field.goalAreaLength, field.goalAreaWidth);
  area(field.penaltyAreaLength, field.penaltyAreaWidth);
  for (const double side : {-1.0, 1.0}) {
    const double front = side * field.halfLength(), back = front + side * field.goalDepth;
    shapes.goals.push_back({{std::min(front, back), -field.goalWidth / 2},
                            {std::max(front, back), field.goalWidth / 2}});
    if (field.penaltyMarkDistance > 0) {
      shapes.marks.push_back({front - side * field.penaltyMarkDistance, 0});
    }
  }
  shapes.circleRadius = std::max(field.centreCircleDiameter / 2 - inset, 0.0);
  shapes.arcRadius = std::max(field.cornerArcRadius - inset, 0.0);
  if (field.markDiameter > 0) shapes.markRadius = std::max(field.markDiameter / 2, inset);
  return shapes;
}

}  // namespace pitchboard::sim
