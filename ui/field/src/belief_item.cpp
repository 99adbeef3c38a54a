// SPDX-License-Identifier: GPL-3.0-or-later
#include "belief_item.h"

#include <algorithm>
#include <cmath>

#include <robotlink/frame/robot_frame.h>
#include <ui/base/theme.h>

#include "field_stamps.h"

namespace pitchboard::ui {
namespace {

constexpr double fullUntil = 0.3;   // m of uncertainty; beyond it the disc thins out
constexpr double noseReach = 1.75;  // of the ghost's radius

}  // namespace

BeliefLook beliefOf(const link::RobotFrame& robot, const sim::FieldSpec& field) {
  BeliefLook look;
  look.team = robot.identity.team;
  look.ghost = !robot.link;
  look.believed = robot.belief;
  if (look.believed) {
    const double sigma = robot.sigma.value_or(0.0);
    look.sigma = std::isfinite(sigma) ? std::clamp(sigma, 0.0, field.length) : field.length;
  }
  look.number = robot.identity.number;
  if (look.ghost && look.believed) {
    const Point& there = look.believed->position;
    if (pitchboard::distance(there, robot.pose.position) >= BeliefItem::apart) {
      look.stands = robot.pose.position;
    }
  }
  look.origin = robot.belief.value_or(robot.pose).position;
  if (robot.ball) look.ball = robot.ball->place;
  look.opacity = robot.timedOut() ? 0.45 : 1.0;
  return look;
}

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
    const double radius = std::max({m_look.sigma, minRadius, ghostRadius() * noseReach}) + margin;
    const QPointF at = toScene(m_look.believed->position);
    bounds = QRectF(at.x() - radius, at.y() - radius, 2 * radius, 2 * radius);
    if (m_look.stands) {
      const QPointF robot = toScene(*m_look.stands);
      bounds |= QRectF(robot.x() - margin, robot.y() - margin, 2 * margin, 2 * margin);
    }
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
  if (m_look.believed) {
    const ScreenPainting screen(painter, toScene(m_look.believed->position));
    if (m_style->shows(FieldLayer::Belief)) paintDisc(painter, screen);
    if (m_look.ghost && m_style->shows(FieldLayer::Ghost)) paintGhost(painter, screen);
  }
  if (m_look.ball && m_style->shows(FieldLayer::PerceivedBall)) paintPerceivedBall(painter);
}

void BeliefItem::paintDisc(QPainter* painter, const ScreenPainting& screen) const {
  const double scale = screen.pixelsPerMetre();
  const QColor team = theme().team(m_look.team);
  // In half pixels, whole ones or two as it is wider, so that a changing uncertainty still finds
  // its stamp.
  const double across = 2 * std::max(m_look.sigma, minRadius) * scale;
  const int grain = across > 80 ? 4 : across > 40 ? 2 : 1;
  const int size = static_cast<int>(std::lround(across / grain)) * grain;
  const double radius = size / 2.0;
  // One that knows nothing must not cover the field: what is spread over more ground is thinner.
  const double thin = std::min(1.0, fullUntil / std::max(m_look.sigma, minRadius));
  QColor fill = team;
  fill.setAlpha(static_cast<int>(std::lround((isDarkTheme() ? 38 : 56) * thin)));
  QPen pen(onGrass(isDarkTheme() ? team : team.darker(115), std::max(0.45, std::sqrt(thin))), 1.3);
  pen.setDashPattern({3.0, 2.4});
  pen.setCapStyle(Qt::FlatCap);
  drawStamp(painter, {}, {Stamp::Kind::Belief, size, fill.rgba(), pen.color().rgba(), {}},
            {radius + 2, radius + 2}, [&](QPainter& p) {
              p.setPen(pen);
              p.setBrush(fill);
              p.drawEllipse(QPointF(0, 0), radius, radius);
            });
}

void BeliefItem::paintGhost(QPainter* painter, const ScreenPainting& screen) const {
  const double radius = ghostRadius() * screen.pixelsPerMetre();
  const QColor line = onGrass(theme().fieldLines, isDarkTheme() ? 0.72 : 0.95);
  if (m_look.stands) {
    const QPointF robot =
        screen.pixels(toScene(*m_look.stands) - toScene(m_look.believed->position));
    const double away = std::hypot(robot.x(), robot.y());
    painter->setPen(QPen(line, 0.8));
    if (away > radius) painter->drawLine(robot * (radius / away), robot);
  }
  const double stroke = std::clamp(radius * 0.13, 1.2, 2.2);
  const bool numbered =
      m_look.number > 0 && radius >= readable_px && m_style->shows(FieldLayer::Numbers);
  const QString number = numbered ? QString::number(m_look.number) : QString();
  drawStamp(
      painter, {}, {Stamp::Kind::Ghost, stampSize(radius), line.rgba(), 0, number},
      {radius + 2, radius + 2}, [&](QPainter& p) {
        p.setPen(QPen(line, stroke));
        p.setBrush(Qt::NoBrush);
        p.drawEllipse(QPointF(0, 0), radius, radius);
        if (number.isEmpty()) return;
        p.setFont(fieldFont(
            static_cast<int>(std::lround(std::max(8.0, radius * (number.size() > 1 ? 1.05 : 1.3)))),
            false));
        p.drawText(QRectF(-radius, -radius, 2 * radius, 2 * radius), Qt::AlignCenter, number);
      });
  // The same nose as a robot's, so that both read alike.
  const QPointF ahead = screen.direction(m_look.believed->yaw), side(-ahead.y(), ahead.x());
  const QPointF nose[] = {ahead * radius * noseReach, ahead * radius * 1.12 + side * radius * 0.45,
                          ahead * radius * 1.12 - side * radius * 0.45};
  painter->setPen(Qt::NoPen);
  painter->setBrush(line);
  painter->drawPolygon(nose, 3);
}

double BeliefItem::ghostRadius() const {
  return std::max(m_style->field.robotRadius, m_style->metres(5.0)) * 0.85;
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
    QPen pen(onGrass(theme().ball, 1.0), 1.0);  // wider ones take Qt three times as long
    pen.setDashPattern({4.2, 3.1});
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
