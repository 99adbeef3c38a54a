// SPDX-License-Identifier: GPL-3.0-or-later
#include "compared_item.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>
#include <utility>

#include <ui/base/quick_painting.h>
#include <ui/base/robot_text.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr float sessionTint = 0.4F;
constexpr std::uint32_t mostRobots = 1000;  // of a session

const QFont& nameFont() {
  return fieldFont(10, false);
}

QSizeF sizeOf(const QString& name) {
  return {textLineWidth(nameFont(), name) + 2, QFontMetricsF(nameFont()).ascent()};
}

}  // namespace

void ComparedItem::setFrame(const FramePtr& frame) {
  prepareGeometryChange();
  const std::vector<Robot> before = std::exchange(m_robots, {});
  m_ball.reset();
  for (const link::RobotFrame& robot : frame->robots) {
    if (!robot.poseKnown()) continue;
    const std::size_t index = m_robots.size();
    Robot& shown = m_robots.emplace_back();
    shown.name = robotName(robot) + sessionMark(m_number);
    // Measuring a text takes longer than comparing it.
    if (index < before.size() && before[index].name == shown.name) {
      shown = before[index];
    } else {
      shown.nameSize = sizeOf(shown.name);
    }
    shown.pose = robot.pose;
    shown.team = robot.identity.team;
    shown.fallen = robot.fallen;
  }
  if (frame->ballKnown) m_ball = frame->snapshot.ball;
  update();
}

RobotUid ComparedItem::idOf(std::size_t index) const {
  return {static_cast<std::uint32_t>(m_number) * mostRobots + static_cast<std::uint32_t>(index)};
}

QPointF ComparedItem::onScreen(const Robot& robot) const {
  const double scale = m_style->pixelsPerMetre, side = m_style->flipped ? -1.0 : 1.0;
  return {side * robot.pose.position.x * scale, -side * robot.pose.position.y * scale};
}

void ComparedItem::addNamed(std::vector<NamedRobot>& all) const {
  const double radius = m_style->robotDrawRadius() * m_style->pixelsPerMetre;
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    all.push_back({idOf(i), onScreen(m_robots[i]), radius, m_robots[i].nameSize});
  }
}

void ComparedItem::placeNames(const std::map<RobotUid, QPointF>& centres) {
  constexpr double still = 0.01;  // px
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    const QPointF offset = centres.at(idOf(i)) - onScreen(m_robots[i]);
    if (distance(offset, m_robots[i].nameOffset) < still) continue;
    prepareGeometryChange();
    m_robots[i].nameOffset = offset;
    update();
  }
}

std::vector<QRectF> ComparedItem::nameRects() const {
  std::vector<QRectF> all;
  for (const Robot& robot : m_robots) {
    QRectF rect(QPointF(), robot.nameSize);
    rect.moveCenter(onScreen(robot) + robot.nameOffset);
    all.push_back(rect);
  }
  return all;
}

QRectF ComparedItem::boundingRect() const {
  QRectF all;
  const auto include = [&all](const Point& at, double reach) {
    all |= QRectF(at.x - reach, at.y - reach, 2 * reach, 2 * reach);
  };
  const double disc = m_style->robotDrawRadius() * 1.5;
  for (const Robot& robot : m_robots) {
    const double name_px =
        std::hypot(robot.nameOffset.x(), robot.nameOffset.y()) + robot.nameSize.width() / 2 + 6.0;
    include(robot.pose.position, std::max(disc, m_style->metres(name_px)));
  }
  if (m_ball) include(*m_ball, disc);
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
  drawHaloText(painter, robot.nameOffset, robot.name, nameFont(),
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
