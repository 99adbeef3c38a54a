// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_items.h"

#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QColor halo() {
  return theme().fieldBorder.darker(isDarkTheme() ? 130 : 190);
}

}  // namespace

void TeamBallItem::setBall(const std::optional<link::TeamBall>& ball) {
  setVisible(ball.has_value());
  if (!ball) return;
  prepareGeometryChange();
  m_ball = *ball;
  m_plate = plateSize(words());
  setPos(toScene(ball->position));
  update();
}

QString TeamBallItem::words() const {
  return QStringLiteral("%1 of %2 agree").arg(m_ball.agree).arg(m_ball.see);
}

double TeamBallItem::radius() const {
  return std::max(m_ball.spread, m_style->ballDrawRadius() + m_style->metres(5.0));
}

QRectF TeamBallItem::boundingRect() const {
  const double reach = radius() + m_style->metres(14.0 + m_plate.height());
  const double wide = radius() + m_style->metres(16.0 + m_plate.width());
  return {-wide, -reach, 2 * wide, 2 * reach};
}

void TeamBallItem::setRobots(std::vector<QPointF> robots, double radius) {
  m_robots = std::move(robots);
  m_robotRadius = radius;
}

// Above the ring, else below, else beside it: the first place that no robot covers.
QPointF TeamBallItem::wordsAt(const ScreenPainting& screen, double ring) const {
  const double high = ring + 12.0, wide = ring + 6.0 + m_plate.width() / 2;
  const double robot = m_robotRadius * screen.pixelsPerMetre();
  const QPointF places[] = {{0, -high}, {0, high}, {wide, 0}, {-wide, 0}};
  for (const QPointF& place : places) {
    const QRectF box(place - QPointF(m_plate.width(), m_plate.height()) / 2, m_plate);
    const bool covered = std::ranges::any_of(m_robots, [&](const QPointF& each) {
      const QPointF at = screen.pixels(each - pos());
      return box.adjusted(-robot, -robot, robot, robot).contains(at);
    });
    if (!covered) return place;
  }
  return places[0];
}

void TeamBallItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const ScreenPainting screen(painter, QPointF(0, 0));
  const double ring = radius() * screen.pixelsPerMetre();
  const double arm = 4.0;
  QPen pen(theme().ball, 1.8);
  pen.setCapStyle(Qt::FlatCap);
  painter->setPen(pen);
  painter->setBrush(Qt::NoBrush);
  painter->drawEllipse(QPointF(0, 0), ring, ring);
  painter->drawLine(QPointF(-arm, 0), QPointF(arm, 0));
  painter->drawLine(QPointF(0, -arm), QPointF(0, arm));
  drawPlateText(painter, wordsAt(screen, ring), words());
}

void OtherPoseItem::setOther(const OtherPose& other) {
  if (other == m_other) return;
  prepareGeometryChange();
  m_other = other;
  setPos(toScene(other.pose.position));
  update();
}

QRectF OtherPoseItem::boundingRect() const {
  const double reach = m_style->robotDrawRadius() * 1.5 + m_style->metres(24.0);
  const double wide = reach + m_style->metres(30.0);
  const QRectF own(-wide, -reach, 2 * wide, 2 * reach);
  const QPointF joined = toScene(m_other.here) - toScene(m_other.pose.position);
  const double margin = m_style->metres(2.0);
  return own.united(
      QRectF(QPointF(0, 0), joined).normalized().adjusted(-margin, -margin, margin, margin));
}

void OtherPoseItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const ScreenPainting screen(painter, QPointF(0, 0));
  const double radius = std::max(m_style->field.robotRadius * screen.pixelsPerMetre(), 5.0);
  const QColor line = theme().accentLine;
  QPen pen(line, 1.8, Qt::SolidLine, Qt::FlatCap);
  const QPointF robot = screen.pixels(toScene(m_other.here) - toScene(m_other.pose.position));
  const double away = std::hypot(robot.x(), robot.y());
  painter->setPen(QPen(line, 1.2, Qt::DotLine));
  if (away > radius) painter->drawLine(robot * (radius / away), robot);
  pen.setDashPattern({1.5, 1.5});
  painter->setPen(pen);
  painter->setBrush(Qt::NoBrush);
  painter->drawEllipse(QPointF(0, 0), radius, radius);
  pen.setStyle(Qt::SolidLine);
  painter->setPen(pen);
  painter->drawLine(QPointF(0, 0), screen.direction(m_other.pose.yaw) * radius * 1.35);
  drawHaloText(painter, {0, -radius - 10}, m_other.words, fieldFont(10, false), theme().fieldLines,
               halo());
}

}  // namespace pitchboard::ui
