// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Paints the ground of a field: border, grass and lines in the colours of the theme. UI thread
// only.

#include <QRectF>

#include <simcore/world/field_lines.h>

class QPainter;

namespace pitchboard::ui {

inline QRectF rectOf(const sim::FieldLines::Box& box) {
  return {QPointF(box.low.x, box.low.y), QPointF(box.high.x, box.high.y)};
}

/// The painter's units must be metres; +y may point up or down. `lineWidth` as in
/// sim::fieldLines().
void paintGround(QPainter& painter, const sim::FieldSpec& field, double lineWidth);

}  // namespace pitchboard::ui
