// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/field_ground.h>

#include <QPainter>
#include <algorithm>

#include <ui/base/theme.h>

namespace pitchboard::ui {

void paintGround(QPainter& painter, const sim::FieldSpec& field, double lineWidth) {
  const QRectF grass(-field.halfLength(), -field.halfWidth(), field.length, field.width);
  painter.fillRect(grass.adjusted(-field.border, -field.border, field.border, field.border),
                   theme().fieldBorder);
  painter.fillRect(grass, theme().grass);
  const sim::FieldLines shapes = sim::fieldLines(field, lineWidth);
  // Filled: while the view is resized all this is painted for every size, and strokes of lines
  // that are as long as the field took most of that.
  for (const auto& line : shapes.lines) painter.fillRect(rectOf(line), theme().fieldLines);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme().fieldLines, lineWidth, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin));
  if (shapes.circleRadius > 0) {
    painter.drawEllipse(QPointF(), shapes.circleRadius, shapes.circleRadius);
  }
  if (shapes.arcRadius > 0) {
    const double r = shapes.arcRadius;
    for (const double x : {-field.halfLength(), field.halfLength()}) {
      for (const double y : {-field.halfWidth(), field.halfWidth()}) {
        // Qt's angles turn from +x towards −y.
        const int start = x < 0 ? (y < 0 ? 270 : 0) : (y < 0 ? 180 : 90);
        painter.drawArc(QRectF(x - r, y - r, 2 * r, 2 * r), start * 16, 90 * 16);
      }
    }
  }
  if (shapes.markRadius > 0) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme().fieldLines);
    painter.drawEllipse(QPointF(), shapes.markRadius, shapes.markRadius);
    for (const Point& mark : shapes.marks) {
      painter.drawEllipse(QPointF(mark.x, mark.y), shapes.markRadius, shapes.markRadius);
    }
    return;
  }
  // A cross as thick as a line would be a blot at this size.
  const double arm = std::max(0.08, 1.6 * lineWidth);
  QPen thin = painter.pen();
  thin.setWidthF(0.7 * lineWidth);
  painter.setPen(thin);
  for (const Point& mark : shapes.marks) {
    painter.drawLine(QPointF(mark.x - arm, mark.y), QPointF(mark.x + arm, mark.y));
    painter.drawLine(QPointF(mark.x, mark.y - arm), QPointF(mark.x, mark.y + arm));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().fieldLines);
  painter.drawEllipse(QPointF(), 0.9 * lineWidth, 0.9 * lineWidth);
}

}  // namespace pitchboard::ui
