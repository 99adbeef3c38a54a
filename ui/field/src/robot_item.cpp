// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot_item.h"

#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

#include "field_stamps.h"

namespace pitchboard::ui {
namespace {

constexpr double handleGap_px = 18.0;

void paintNumber(QPainter& painter, double radius, const QString& text) {
  const double size = radius * (text.size() > 1 ? 1.12 : 1.38);
  painter.setFont(fieldFont(static_cast<int>(std::lround(std::max(8.0, size))), true));
  painter.setPen(Qt::white);
  painter.drawText(QRectF(-radius, -radius, 2 * radius, 2 * radius), Qt::AlignCenter, text);
}

QPointF across(const QPointF& direction) {
  return {-direction.y(), direction.x()};
}

}  // namespace

RobotItem::RobotItem(const FieldStyle* style, RobotUid id) : FieldItem(style), m_id(id) {}

void RobotItem::setLook(const RobotLook& look) {
  if (look == m_look) return;
  if (look.selected != m_look.selected || look.followed != m_look.followed ||
      look.tag != m_look.tag || look.radius != m_look.radius) {
    prepareGeometryChange();
  }
  const bool moved = !(look.pose.position == m_look.pose.position);
  m_look = look;
  if (moved) setPos(toScene(look.pose.position));
  update();
}

void RobotItem::setTagPosition(const std::optional<QPointF>& place) {
  if (m_tagPosition == place) return;
  prepareGeometryChange();
  m_tagPosition = place;
  update();
}

QPointF RobotItem::handlePosition(const FieldStyle& style, const Pose& pose, double radius) {
  const double reach = style.drawRadius(radius) * 1.7 + style.metres(handleGap_px);
  return {pose.position.x + reach * std::cos(pose.yaw),
          pose.position.y + reach * std::sin(pose.yaw)};
}

double RobotItem::handleRadius(const FieldStyle& style) {
  return style.metres(5.0);
}

QRectF RobotItem::boundingRect() const {
  const double radius = bodyRadius();
  double reach = radius * 1.8 + m_style->metres(3.0);
  if (m_look.selected || m_look.followed) {
    reach =
        std::max(radius * 1.8, radius * 1.7 + m_style->metres(handleGap_px)) + m_style->metres(8.0);
  }
  QRectF area(-reach, -reach, 2 * reach, 2 * reach);
  if (m_tagPosition && !m_look.tag.isEmpty()) {
    const QSizeF plate = plateSize(m_look.tag) / 2;
    const double half = m_style->metres(std::abs(m_tagPosition->x()) + plate.width() + 2.0);
    const double tall = m_style->metres(std::abs(m_tagPosition->y()) + plate.height() + 2.0);
    area = area.united(QRectF(-half, -tall, 2 * half, 2 * tall));
  }
  return area;
}

void RobotItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const ScreenPainting screen(painter, QPointF(0, 0));
  const double radius = bodyRadius() * screen.pixelsPerMetre();
  if (m_style->ornaments && (m_look.selected || m_look.followed)) {
    paintSelection(painter, screen, radius);
  }
  // One that is not heard is faint; what is said of it is not.
  const double before = painter->opacity();
  painter->setOpacity(before * m_look.opacity);
  paintBody(painter, screen, radius);
  painter->setOpacity(before);
  if (m_tagPosition && !m_look.tag.isEmpty()) {
    drawPlateText(painter, *m_tagPosition, m_look.tag);
  }
}

void RobotItem::paintSelection(QPainter* painter, const ScreenPainting& screen,
                               double radius) const {
  const QColor accent = theme().accentLine;
  painter->setBrush(Qt::NoBrush);
  const double ring = radius + std::max(5.0, radius * 0.35);
  if (m_look.followed) {
    painter->setPen(QPen(accent, 1.2, Qt::DotLine));
    painter->drawEllipse(QPointF(0, 0), ring + 3.5, ring + 3.5);
  }
  if (!m_look.selected) return;
  const QPen pen(accent, 2.2, Qt::SolidLine, Qt::FlatCap);
  const auto paintRing = [&](double ringRadius, const QColor& ground) {
    return [&pen, ringRadius, ground](QPainter& p) {
      p.setPen(pen);
      p.setBrush(ground);
      p.drawEllipse(QPointF(0, 0), ringRadius, ringRadius);
    };
  };
  drawStamp(painter, {}, {Stamp::Kind::Ring, stampSize(ring), accent.rgba(), 0, {}},
            {ring + 2, ring + 2}, paintRing(ring, Qt::transparent));
  if (m_style->readOnly) return;
  painter->setPen(pen);
  const QPointF ahead = screen.direction(m_look.pose.yaw);
  const double reach = radius * 1.7 + handleGap_px;
  painter->drawLine(ahead * ring, ahead * (reach - 4));
  const QColor inside = theme().fieldBorder;
  drawStamp(painter, ahead * reach,
            {Stamp::Kind::Ring, stampSize(4.0), accent.rgba(), inside.rgba(), {}}, {6, 6},
            paintRing(4.0, inside));
}

void RobotItem::paintBody(QPainter* painter, const ScreenPainting& screen, double radius) const {
  const QColor team = theme().team(m_look.team);
  const QColor outline = isDarkTheme() ? QColor(16, 20, 24) : QColor(26, 34, 42);
  const QPointF ahead = screen.direction(m_look.pose.yaw);
  const QPointF side = across(ahead);
  const double stroke = std::clamp(radius * 0.11, 1.0, 2.5);
  painter->setPen(QPen(outline, stroke, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  if (m_look.fallen) {
    // Lying along its heading: a long body instead of a disc, without a nose.
    QPen body(outline, radius * 1.25 + 2 * stroke, Qt::SolidLine, Qt::RoundCap);
    painter->setPen(body);
    painter->drawLine(-ahead * radius * 0.75, ahead * radius * 0.75);
    body.setColor(team);
    body.setWidthF(radius * 1.25);
    painter->setPen(body);
    painter->drawLine(-ahead * radius * 0.75, ahead * radius * 0.75);
  } else {
    // Two filled triangles, because an outline of every robot in every frame costs more than all
    // else that is painted of it.
    const QPointF middle = ahead * radius * 0.87;  // as far from each side
    const double inner = radius * 0.42;
    const auto fill = [&](double grown, const QColor& color) {
      const double factor = (inner + grown) / inner;
      QPointF nose[] = {ahead * radius * 1.62, ahead * radius * 0.45 + side * radius * 0.80,
                        ahead * radius * 0.45 - side * radius * 0.80};
      for (QPointF& corner : nose) corner = middle + (corner - middle) * factor;
      painter->setBrush(color);
      painter->drawPolygon(nose, 3);
    };
    painter->setPen(Qt::NoPen);
    fill(stroke / 2, outline);
    fill(-stroke / 2, team.darker(112));
  }
  const bool numbered = m_style->shows(FieldLayer::Numbers);
  const bool fitsInside = radius >= 6.5;
  const QString text = numbered && fitsInside ? QString::number(m_look.number) : QString();
  if (m_look.fallen) {
    if (!text.isEmpty()) paintNumber(*painter, radius, text);
  } else {
    drawStamp(painter, {},
              {Stamp::Kind::Disc, stampSize(radius), team.rgba(), outline.rgba(), text},
              {radius + stroke, radius + stroke}, [&](QPainter& p) {
                p.setPen(QPen(outline, stroke));
                p.setBrush(team);
                p.drawEllipse(QPointF(0, 0), radius, radius);
                if (!text.isEmpty()) paintNumber(p, radius, text);
              });
  }
}

}  // namespace pitchboard::ui
