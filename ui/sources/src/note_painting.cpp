// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/note_painting.h>

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPathStroker>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <ui/base/theme.h>

namespace pitchboard::ui {

using telemetry::DrawnNote;
using telemetry::NotePlace;
using telemetry::NoteShape;

namespace {

// Readable on grass, on plots of both themes and on any picture: bright on a dark rim.
const QColor noteColor(255, 214, 64), noteRim(20, 20, 20, 190), labelGround(20, 20, 20, 215);
constexpr double lineWidth = 2.5, rimWidth = 5.5, tipLength = 13.0, smallest = 5.0;
constexpr double longestLabel = 360.0;  // px

QPointF atPixel(const Point& point, const QTransform& toPixels) {
  return toPixels.map(QPointF(point.x, point.y));
}

/// Half the width and height of a circle: round where lengths are the same in both directions.
QSizeF radii(const DrawnNote& note, const QTransform& toPixels) {
  const QPointF off = atPixel(note.to, toPixels) - atPixel(note.from, toPixels);
  if (note.place == NotePlace::Plot) {
    // Times and values have no common length: an ellipse through the end of the drag.
    return {std::max(std::abs(off.x()) * std::numbers::sqrt2, smallest),
            std::max(std::abs(off.y()) * std::numbers::sqrt2, smallest)};
  }
  const double radius = std::max(std::hypot(off.x(), off.y()), smallest);
  return {radius, radius};
}

QPainterPath linesOf(const DrawnNote& note, const QTransform& toPixels) {
  QPainterPath path;
  const QPointF from = atPixel(note.from, toPixels), to = atPixel(note.to, toPixels);
  if (note.shape == NoteShape::Circle) {
    const QSizeF half = radii(note, toPixels);
    path.addEllipse(from, half.width(), half.height());
  } else if (note.shape == NoteShape::Arrow) {
    const QPointF way = to - from;
    const double length = std::hypot(way.x(), way.y());
    path.moveTo(from);
    path.lineTo(to);
    if (length < 1.0) return path;
    const QPointF along = way / length * std::min(tipLength, length);
    const QPointF side = QPointF(-along.y(), along.x()) * 0.55;
    path.moveTo(to - along + side);
    path.lineTo(to);
    path.lineTo(to - along - side);
  }
  return path;
}

QFont labelFont() {
  return themeFont(TypeRole::Body, true);
}

QString labelText(const DrawnNote& note) {
  return QFontMetricsF(labelFont())
      .elidedText(QString::fromStdString(note.text), Qt::ElideRight, longestLabel);
}

/// Beside a text's own place, the tail of an arrow, or above a circle.
QRectF labelRect(const DrawnNote& note, const QTransform& toPixels) {
  const QString text = labelText(note);
  if (text.isEmpty()) return {};
  const QFontMetricsF metrics(labelFont());
  QRectF rect(0, 0, metrics.horizontalAdvance(text) + 12, metrics.height() + 4);
  const QPointF from = atPixel(note.from, toPixels);
  if (note.shape == NoteShape::Circle) {
    rect.moveCenter(from - QPointF(0, radii(note, toPixels).height() + rect.height() / 2 + 4));
  } else if (note.shape == NoteShape::Arrow) {
    const QPointF way = from - atPixel(note.to, toPixels);
    // On the other side of the tail than the tip.
    const double across = std::abs(way.x()) > std::abs(way.y()) ? rect.width() / 2 + 2 : 0.0;
    const double up = across == 0.0 ? rect.height() / 2 + 2 : 0.0;
    rect.moveCenter(from + QPointF(way.x() < 0 ? -across : across, way.y() < 0 ? -up : up));
  } else {
    rect.moveCenter(from);
  }
  return rect;
}

/// A frame has the time of its last row, a little before the moment for which it stands.
bool isInFrame(const DrawnNote& note, double frameTime) {
  constexpr double betweenRows = 0.05;  // s
  return note.isShownAt(frameTime) || note.isShownAt(frameTime + betweenRows);
}

}  // namespace

void paintNote(QPainter& painter, const DrawnNote& note, const QTransform& toPixels,
               double strength) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setOpacity(strength);
  const QPainterPath lines = linesOf(note, toPixels);
  for (const auto& [color, width] : {std::pair(noteRim, rimWidth), {noteColor, lineWidth}}) {
    painter.strokePath(lines, QPen(color, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  }
  if (const QRectF rect = labelRect(note, toPixels); !rect.isEmpty()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(labelGround);
    painter.drawRoundedRect(rect, 4, 4);
    painter.setPen(noteColor);
    painter.setFont(labelFont());
    painter.drawText(rect, Qt::AlignCenter, labelText(note));
  }
  painter.restore();
}

void paintFieldNotes(QPainter& painter, std::span<const DrawnNote> notes,
                     const QTransform& toPixels, double time) {
  for (const DrawnNote& note : notes) {
    if (note.place == NotePlace::Field && isInFrame(note, time)) paintNote(painter, note, toPixels);
  }
}

void paintVideoNotes(QPainter& painter, std::span<const DrawnNote> notes, const std::string& name,
                     const QRectF& rect, double time) {
  painter.save();
  painter.setClipRect(rect);
  for (const DrawnNote& note : notes) {
    if (note.place != NotePlace::Video || note.on != name || !isInFrame(note, time)) continue;
    paintNote(painter, note, fromShares(rect));
  }
  painter.restore();
}

QPainterPath outlineOf(const DrawnNote& note, const QTransform& toPixels) {
  constexpr double reach = 14.0;  // px, of the whole line
  QPainterPathStroker stroker;
  stroker.setWidth(reach);
  QPainterPath outline = stroker.createStroke(linesOf(note, toPixels));
  outline.setFillRule(Qt::WindingFill);
  if (const QRectF rect = labelRect(note, toPixels); !rect.isEmpty()) outline.addRect(rect);
  return outline;
}

QTransform fromShares(const QRectF& rect) {
  return QTransform::fromScale(rect.width(), rect.height()) *
         QTransform::fromTranslate(rect.left(), rect.top());
}

}  // namespace pitchboard::ui
