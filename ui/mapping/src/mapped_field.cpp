// SPDX-License-Identifier: GPL-3.0-or-later
#include "mapped_field.h"

#include <QPainter>
#include <algorithm>

#include <base/angles.h>
#include <ui/base/field_ground.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

MappedField::MappedField(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("mappingField"));
  setMinimumHeight(scaled(this, 140));
}

void MappedField::setSample(const link::MappingSample& sample) {
  m_field = sample.field;
  m_robots = sample.robots;
  QStringList names;
  for (const link::RobotFrame& robot : m_robots) names << QString::fromStdString(robot.name);
  setAccessibleName(QStringLiteral("Field with robots: %1").arg(names.join(QStringLiteral(", "))));
  update();
}

QSize MappedField::sizeHint() const {
  return {scaled(this, 340), scaled(this, 230)};
}

void MappedField::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double across = m_field.length + 2.0 * m_field.border,
               along = m_field.width + 2.0 * m_field.border;
  const double scale = std::min(width() / across, height() / along);
  painter.translate(width() / 2.0, height() / 2.0);
  painter.scale(scale, -scale);
  paintGround(painter, m_field, std::max(0.05, 1.0 / scale));
  for (const link::RobotFrame& robot : m_robots) {
    if (robot.belief) paintRobot(painter, robot);
  }
}

void MappedField::paintRobot(QPainter& painter, const link::RobotFrame& robot) const {
  constexpr double radius = 0.22, ballRadius = 0.1;  // m
  const QColor colour = theme().team(robot.identity.team);
  const QPointF place(robot.belief->position.x, robot.belief->position.y);
  if (robot.sigma) {
    QColor faint = colour;
    faint.setAlphaF(0.25F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(faint);
    painter.drawEllipse(place, *robot.sigma, *robot.sigma);
  }
  painter.setPen(QPen(theme().fieldLines, 0.04));
  if (robot.ball) {
    const QPointF ball(robot.ball->place.x, robot.ball->place.y);
    painter.drawLine(place, ball);
    painter.setBrush(theme().ball);
    painter.drawEllipse(ball, ballRadius, ballRadius);
  }
  painter.save();
  painter.translate(place);
  painter.rotate(degreesFromRadians(robot.belief->yaw));
  painter.setBrush(colour);
  painter.drawEllipse(QPointF(), radius, radius);
  painter.drawLine(QPointF(), QPointF(1.8 * radius, 0.0));
  painter.restore();
  painter.save();
  painter.translate(place + QPointF(0.0, 1.5 * radius));
  painter.scale(0.02, -0.02);
  QFont font = themeFont(TypeRole::Body, true);
  font.setPixelSize(20);
  painter.setFont(font);
  painter.setPen(Qt::white);
  painter.drawText(QRectF(-60.0, -24.0, 120.0, 24.0), Qt::AlignHCenter | Qt::AlignBottom,
                   QString::fromStdString(robot.name));
  painter.restore();
}

}  // namespace pitchboard::ui
