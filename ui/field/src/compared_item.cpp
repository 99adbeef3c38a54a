// SPDX-License-Identifier: GPL-3.0-or-later
#include "compared_item.h"

#include <algorithm>

#include <ui/base/robot_text.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double labelReach_px = 26.0;  // number above a disc
constexpr float sessionTint = 0.4F;

}  // namespace

void ComparedItem::setFrame(const FramePtr& frame) {
  prepareGeometryChange();
  m_robots.clear();
  m_ball.reset();
  for (const link::RobotFrame& robot : frame->robots) {
    if (!robot.poseKnown()) continue;
    m_robots.push_back({robot.pose, robot.identity.team, robotName(robot), robot.fallen});
  }
  if (frame->ballKnown) m_ball = frame->snapshot.ball;
  update();
}

QRectF ComparedItem::boundingRect() const {
  QRectF all;
  const double reach = m_style->robotDrawRadius() * 1.5 + m_style->metres(labelReach_px);
  const auto include = [&](const Point& at) {
    all |= QRectF(at.x - reach, at.y - reach, 2 * reach, 2 * reach);
  };
  for (const Robot& robot : m_robots) include(robot.pose.position);
  if (m_ball) include(*m_ball);
  return all;
}

void ComparedItem::paintRobot(QPainter* painter, const Robot& robot) const {
  const ScreenPainting screen(painter, toScene(robot.pose.position));
  const double radius = m_style->robotDrawRadius() * screen.pixelsPerMetre();
  const QColor team = theme().team(robot.team);
  const QColor line = isDarkTheme() ? team.lighter(125) : team.darker(125);
  const QColor hatch = m_number > 0 ? sessionColor(m_number) : line;
  painter->setPen(QPen(line, 1.6));
  if (m_number > 0) {
    // A tint below the hatching, so that sessions are told apart where discs are small.
    QColor tint = hatch;
    tint.setAlphaF(sessionTint);
    painter->setBrush(tint);
    painter->drawEllipse(QPointF(0, 0), radius, radius);
  }
  painter->setBrush(QBrush(hatch, robot.fallen ? Qt::DiagCrossPattern : Qt::BDiagPattern));
  painter->drawEllipse(QPointF(0, 0), radius, radius);
  painter->drawLine(QPointF(0, 0), screen.direction(robot.pose.yaw) * radius * 1.35);
  if (!m_style->shows(FieldLayer::Numbers)) return;
  drawHaloText(painter, {0, radius + 9}, robot.name + sessionMark(m_number), fieldFont(10, false),
               m_number > 0 && isDarkTheme() ? hatch : theme().fieldLines,
               theme().fieldBorder.darker(isDarkTheme() ? 130 : 190));
}

void ComparedItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  for (const Robot& robot : m_robots) paintRobot(painter, robot);
  if (!m_ball) return;
  const ScreenPainting screen(painter, toScene(*m_ball));
  const double radius = std::max(m_style->field.ballRadius * screen.pixelsPerMetre(), 4.0);
  painter->setPen(QPen(theme().ball, 1.6));
  painter->setBrush(QBrush(m_number > 0 ? sessionColor(m_number) : theme().ball, Qt::BDiagPattern));
  painter->drawEllipse(QPointF(0, 0), radius, radius);
}

}  // namespace pitchboard::ui
