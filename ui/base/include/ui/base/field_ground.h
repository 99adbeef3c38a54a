// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ground of a field: border, grass and lines in the colours of the theme, for everything that
// stands or moves on one. UI thread.

#include <QRectF>

#include <simcore/world/field_lines.h>

class QPainter;

namespace pitchboard::ui {

inline QRectF rectOf(const sim::FieldLines::Box& box) {
  return {QPointF(box.low.x, box.low.y), QPointF(box.high.x, box.high.y)};
}

/// Paints in metres, +y up or down. `lineWidth`: as in sim::fieldLines().
void paintGround(QPainter& painter, const sim::FieldSpec& field, double lineWidth);

}  // namespace pitchboard::ui
