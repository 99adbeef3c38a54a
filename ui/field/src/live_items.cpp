// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_items.h"

#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QString textOf(const link::TeamBall& ball) {
  return QStringLiteral("%1 of %2 agree").arg(ball.agree).arg(ball.see);
}

QColor halo() {
  return theme().fieldBorder.darker(isDarkTheme() ? 130 : 190);
}

}  // namespace

void TeamBallsItem::setBalls(std::vector<link::TeamBall> balls) {
  setVisible(!balls.empty());
  prepareGeometryChange();
  m_balls = std::move(balls);
  update();
}

double TeamBallsItem::radius(const link::TeamBall& ball) const {
  return std::max(ball.spread, m_style->ballDrawRadius() + m_style->metres(5.0));
}

QRectF TeamBallsItem::boundingRect() const {
  QRectF bounds;
  for (const link::TeamBall& ball : m_balls) {
    const QSizeF plate = plateSize(textOf(ball));
    const double reach = radius(ball) + m_style->metres(14.0 + plate.height());
    const double wide = radius(ball) + m_style->metres(16.0 + plate.width());
    const QPointF at = toScene(ball.position);
    bounds |= QRectF(at.x() - wide, at.y() - reach, 2 * wide, 2 * reach);
  }
  return bounds;
}

void TeamBallsItem::setRobots(std::vector<QPointF> robots, double radius) {
  m_robots = std::move(robots);
  m_robotRadius = radius;
}

// Above the ring, else below, else beside it: the first place that no robot covers.
QPointF TeamBallsItem::textPosition(const ScreenPainting& screen, const link::TeamBall& ball,
                                    QSizeF plate, double ring) const {
  const double high = ring + 12.0, wide = ring + 6.0 + plate.width() / 2;
  const double robot = m_robotRadius * screen.pixelsPerMetre();
  const QPointF places[] = {{0, -high}, {0, high}, {wide, 0}, {-wide, 0}};
  for (const QPointF& place : places) {
    const QRectF box(place - QPointF(plate.width(), plate.height()) / 2, plate);
    const bool covered = std::ranges::any_of(m_robots, [&](const QPointF& each) {
      const QPointF at = screen.pixels(each - toScene(ball.position));
      return box.adjusted(-robot, -robot, robot, robot).contains(at);
    });
    if (!covered) return place;
  }
  return places[0];
}

void TeamBallsItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  for (const link::TeamBall& ball : m_balls) {
    const ScreenPainting screen(painter, toScene(ball.position));
    const double ring = radius(ball) * screen.pixelsPerMetre();
    const double arm = 4.0;
    // Rings of two teams are told apart by the teams' colours.
    QPen pen(m_balls.size() > 1 ? theme().team(ball.team) : theme().ball, 1.8);
    pen.setCapStyle(Qt::FlatCap);
    painter->setPen(pen);
    painter->setBrush(Qt::NoBrush);
    painter->drawEllipse(QPointF(0, 0), ring, ring);
    painter->drawLine(QPointF(-arm, 0), QPointF(arm, 0));
    painter->drawLine(QPointF(0, -arm), QPointF(0, arm));
    drawPlateText(painter, textPosition(screen, ball, plateSize(textOf(ball)), ring), textOf(ball));
  }
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
  const double radius = m_style->robotDrawRadius() * screen.pixelsPerMetre();
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
  drawHaloText(painter, {0, -radius - 10}, m_other.text, fieldFont(10, false), theme().fieldLines,
               halo());
}

}  // namespace pitchboard::ui
