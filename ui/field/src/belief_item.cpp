// SPDX-License-Identifier: GPL-3.0-or-later
#include "belief_item.h"

#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

#include "field_stamps.h"

namespace pitchboard::ui {

void BeliefItem::setLook(const BeliefLook& look) {
  if (look == m_look) return;
  m_look = look;
  setOpacity(look.opacity);
  styleChanges();
  update();
}

void BeliefItem::styleChanges() {
  const QRectF bounds = computeBounds();
  if (bounds == m_bounds) return;
  prepareGeometryChange();
  m_bounds = bounds;
}

QRectF BeliefItem::computeBounds() const {
  QRectF bounds;
  const double margin = m_style->metres(2.0);
  if (m_look.believed) {
    const double radius =
        std::max({m_look.sigma, leastRadius, m_style->robotDrawRadius()}) + margin;
    const QPointF at = toScene(m_look.believed->position);
    bounds = QRectF(at.x() - radius, at.y() - radius, 2 * radius, 2 * radius);
  }
  if (m_look.ball) {
    const double radius = m_style->ballDrawRadius() + margin;
    const QPointF ball = toScene(*m_look.ball);
    const QPointF from = toScene(m_look.origin);
    bounds |= QRectF(ball.x() - radius, ball.y() - radius, 2 * radius, 2 * radius);
    bounds |= QRectF(from.x() - margin, from.y() - margin, 2 * margin, 2 * margin);
  }
  return bounds;
}

void BeliefItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (m_look.believed) paintGhost(painter);
  if (m_look.ball && m_style->shows(FieldLayer::PerceivedBall)) paintPerceivedBall(painter);
}

void BeliefItem::paintGhost(QPainter* painter) const {
  const ScreenPainting screen(painter, toScene(m_look.believed->position));
  const double scale = screen.pixelsPerMetre();
  const QColor team = theme().team(m_look.team);
  if (m_style->shows(FieldLayer::Belief)) {
    // In half pixels, so that a changing uncertainty still finds its stamp.
    const int size = static_cast<int>(std::lround(2 * std::max(m_look.sigma, leastRadius) * scale));
    const double radius = size / 2.0;
    QColor fill = team;
    fill.setAlphaF(isDarkTheme() ? 0.15F : 0.22F);
    QPen pen(isDarkTheme() ? team : team.darker(115), 1.3);
    pen.setDashPattern({3.0, 2.4});
    pen.setCapStyle(Qt::FlatCap);
    drawStamp(painter, {}, {Stamp::Kind::Belief, size, fill.rgba(), pen.color().rgba(), {}},
              {radius + 2, radius + 2}, [&](QPainter& p) {
                p.setPen(pen);
                p.setBrush(fill);
                p.drawEllipse(QPointF(0, 0), radius, radius);
              });
  }
  if (m_look.ghost && m_style->shows(FieldLayer::Ghost)) {
    const double radius = std::max(m_style->field.robotRadius * scale, 5.0) * 0.85;
    const QColor line = onGrass(theme().fieldLines, isDarkTheme() ? 0.72 : 0.95);
    const QPen pen(line, std::clamp(radius * 0.13, 1.2, 2.2), Qt::SolidLine, Qt::FlatCap);
    drawStamp(painter, {}, {Stamp::Kind::Ghost, stampSize(radius), line.rgba(), 0, {}},
              {radius + 2, radius + 2}, [&](QPainter& p) {
                p.setPen(pen);
                p.setBrush(Qt::NoBrush);
                p.drawEllipse(QPointF(0, 0), radius, radius);
              });
    painter->setPen(pen);
    painter->drawLine(QPointF(0, 0), screen.direction(m_look.believed->yaw) * radius * 1.25);
  }
}

void BeliefItem::paintPerceivedBall(QPainter* painter) const {
  const QRectF area = m_style->playingArea();
  const double reach = m_style->ballDrawRadius();
  const bool inside = area.adjusted(reach, reach, -reach, -reach).contains(toScene(*m_look.ball));
  if (!inside) painter->setClipRect(area);
  paintBallInside(painter);
  if (!inside) painter->setClipping(false);
}

void BeliefItem::paintBallInside(QPainter* painter) const {
  const ScreenPainting screen(painter, toScene(*m_look.ball));
  const double radius = std::max(m_style->field.ballRadius * screen.pixelsPerMetre(), 3.0);
  const QPointF start = screen.pixels(toScene(m_look.origin) - toScene(*m_look.ball));
  const double length = std::hypot(start.x(), start.y());
  if (length > radius + 1) {
    QPen pen(onGrass(theme().ball, 0.85), 1.2);
    pen.setDashPattern({3.5, 2.6});
    pen.setCapStyle(Qt::FlatCap);
    painter->setPen(pen);
    painter->drawLine(start, start * (radius / length));
  }
  const QColor ball = theme().ball;
  drawStamp(painter, {}, {Stamp::Kind::PerceivedBall, stampSize(radius), ball.rgba(), 0, {}},
            {radius + 2, radius + 2}, [&](QPainter& p) {
              p.setPen(QPen(ball, std::clamp(radius * 0.26, 1.6, 3.0)));
              p.setBrush(Qt::NoBrush);
              p.drawEllipse(QPointF(0, 0), radius - 0.5, radius - 0.5);
            });
}

}  // namespace pitchboard::ui
