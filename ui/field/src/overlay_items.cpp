// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay_items.h"

#include <QFontMetricsF>
#include <cmath>

#include <base/angles.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

QString rulerText(const QPointF& from, const QPointF& to) {
  const QPointF offset = to - from;
  const double degrees = degreesFromRadians(std::atan2(offset.y(), offset.x()));
  return fieldNumber(std::hypot(offset.x(), offset.y()), 2) + QStringLiteral(" m   ") +
         fieldNumber(degrees, 1) + QChar(0x00B0);
}

void RulerItem::setLine(const QPointF& from, const QPointF& to) {
  prepareGeometryChange();
  m_from = from;
  m_to = to;
  m_speed.reset();
}

void RulerItem::setArrow(const QPointF& from, const QPointF& to, double speed) {
  setLine(from, to);
  m_speed = speed;
}

QRectF RulerItem::boundingRect() const {
  const double margin = m_style->metres(90.0);
  return QRectF(m_from, m_to).normalized().adjusted(-margin, -margin, margin, margin);
}

void RulerItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const ScreenPainting screen(painter, m_to);
  const QPointF start = screen.pixels(m_from - m_to);
  const double length = std::hypot(start.x(), start.y());
  const QColor accent = theme().accentLine;
  painter->setPen(QPen(accent, 2.0, Qt::SolidLine, Qt::FlatCap));
  painter->drawLine(start, QPointF(0, 0));
  if (m_speed && length > 1) {
    const QPointF along = -start / length;
    const QPointF side(-along.y(), along.x());
    painter->drawLine(QPointF(0, 0), -along * 10 + side * 6);
    painter->drawLine(QPointF(0, 0), -along * 10 - side * 6);
  } else if (length > 1) {
    const QPointF along = -start / length;
    const QPointF side(-along.y(), along.x());
    for (const QPointF& end : {start, QPointF(0, 0)}) {
      painter->drawLine(end - side * 6, end + side * 6);
    }
    // A mark every metre.
    painter->setPen(QPen(accent, 1.2));
    const double metre = screen.pixelsPerMetre();
    for (double at = metre; at < length - 4 && metre > 8; at += metre) {
      painter->drawLine(start + along * at - side * 3, start + along * at + side * 3);
    }
  }
  const QString text =
      m_speed ? fieldNumber(*m_speed, 1) + QStringLiteral(" m/s") : rulerText(m_from, m_to);
  const QFont& font = fieldFont(12, true);
  const QFontMetricsF metrics(font);
  QRectF box(0, 0, metrics.horizontalAdvance(text) + 14, metrics.height() + 6);
  const double below = start.y() > 4 ? -1.0 : 1.0;
  box.moveCenter(QPointF(0, below * (box.height() / 2 + 12)));
  painter->setPen(QPen(accent, 1.0));
  painter->setBrush(theme().window);
  painter->drawRoundedRect(box, 3, 3);
  painter->setFont(font);
  painter->setPen(theme().text);
  painter->drawText(box, Qt::AlignCenter, text);
}

void RubberBandItem::setBand(const QRectF& metres) {
  prepareGeometryChange();
  m_band = metres.normalized();
}

QRectF RubberBandItem::boundingRect() const {
  const double margin = m_style->metres(2.0);
  return m_band.adjusted(-margin, -margin, margin, margin);
}

void RubberBandItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  QColor fill = theme().accentLine;
  fill.setAlphaF(0.14F);
  QPen pen(theme().accentLine, 1.0);
  pen.setCosmetic(true);
  painter->setPen(pen);
  painter->setBrush(fill);
  painter->drawRect(m_band);
}

}  // namespace pitchboard::ui
