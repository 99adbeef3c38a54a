// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball_item.h"

#include <algorithm>

#include <ui/base/theme.h>

#include "field_stamps.h"

namespace pitchboard::ui {

void BallItem::setSelected(bool selected) {
  if (selected == m_selected) return;
  prepareGeometryChange();
  m_selected = selected;
  update();
}

QRectF BallItem::boundingRect() const {
  const double reach = m_style->ballDrawRadius() + m_style->metres(m_selected ? 8.0 : 2.0);
  return {-reach, -reach, 2 * reach, 2 * reach};
}

void BallItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const ScreenPainting screen(painter, QPointF(0, 0));
  const double radius = std::max(m_style->field.ballRadius * screen.pixelsPerMetre(), 3.0);
  if (m_selected && m_style->ornaments) {
    painter->setPen(QPen(theme().accentLine, 2.0));
    painter->setBrush(Qt::NoBrush);
    painter->drawEllipse(QPointF(0, 0), radius + 5, radius + 5);
  }
  const QColor outline = isDarkTheme() ? QColor(16, 20, 24) : QColor(90, 45, 10);
  const QColor ball = theme().ball;
  drawStamp(painter, {}, {Stamp::Kind::Ball, stampSize(radius), ball.rgba(), outline.rgba(), {}},
            {radius + 2, radius + 2}, [&](QPainter& p) {
              p.setPen(QPen(outline, std::clamp(radius * 0.12, 1.0, 2.0)));
              p.setBrush(ball);
              p.drawEllipse(QPointF(0, 0), radius, radius);
            });
}

}  // namespace pitchboard::ui
