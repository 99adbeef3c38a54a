// SPDX-License-Identifier: GPL-3.0-or-later
#include "hover_text.h"

#include <QStringList>
#include <cmath>

#include <base/angles.h>
#include <robotlink/frame/match_frame.h>
#include <ui/base/referee_text.h>
#include <ui/base/robot_text.h>
#include <ui/sources/decider_text.h>
#include <ui/sources/pose_difference.h>

#include "field_style.h"

namespace pitchboard::ui {
namespace {

QString placeText(const Point& p) {
  return QStringLiteral("x %1 m  y %2 m").arg(fieldNumber(p.x, 2), fieldNumber(p.y, 2));
}

QString distanceText(double metres) {
  return metres < 1.0 ? QStringLiteral("%1 cm").arg(std::lround(metres * 100))
                      : QStringLiteral("%1 m").arg(fieldNumber(metres, 2));
}

QString beliefText(const link::MatchFrame& frame, const link::RobotFrame& robot) {
  const QString sure =
      robot.sigma ? QStringLiteral("σ %1").arg(distanceText(*robot.sigma)) : QString();
  if (!frame.truthKnown) return sure.isEmpty() ? sure : QStringLiteral("Belief: %1").arg(sure);
  if (!robot.belief) return QStringLiteral("Belief: localization is not working");
  const double turned = std::abs(wrapToPi(robot.belief->yaw - robot.pose.yaw));
  return QStringLiteral("Belief: %1 and %2° off, %3")
      .arg(distanceText(distance(robot.belief->position, robot.pose.position)))
      .arg(std::lround(degreesFromRadians(turned)))
      .arg(sure);
}

}  // namespace

QString hoverText(const link::MatchFrame& frame, RobotUid id) {
  const link::RobotFrame* robot = frame.robot(id);
  if (robot == nullptr) return {};
  QStringList lines;
  QString head = robotName(*robot);
  if (!robot->ownName.empty()) head += QLatin1Char(' ') + QString::fromStdString(robot->ownName);
  if (const QString decider = deciderText(*robot); !decider.isEmpty())
    head += QStringLiteral(" · ") + decider;
  lines << head;
  lines << QStringLiteral("Action: %1").arg(actionText(robot->decided.value_or(robot->action)));
  if (robot->cognitionDebug && robot->cognitionDebug->path &&
      !robot->cognitionDebug->path->points.empty()) {
    const link::PlannedPath& path = *robot->cognitionDebug->path;
    lines << QStringLiteral("Target: %1%2")
                 .arg(placeText(path.points.back()),
                      path.complete ? QString() : QStringLiteral(" (no path)"));
  }
  if (robot->poseKnown()) {
    lines << QStringLiteral("At %1  %2°")
                 .arg(placeText(robot->pose.position),
                      fieldNumber(degreesFromRadians(robot->pose.yaw), 0));
  }
  if (robot->boardKey || robot->belief) lines << beliefText(frame, *robot);
  if (robot->ball) {
    const Point& ball = robot->ball->place;
    QString seen = QStringLiteral("Sees the ball at %1").arg(placeText(ball));
    if (frame.ballKnown && frame.truthKnown) {
      seen += QStringLiteral(", %1 off").arg(distanceText(distance(ball, frame.snapshot.ball)));
    }
    lines << seen;
  }
  if (robot->timedOut()) {
    lines << QStringLiteral("Last seen %1 ago")
                 .arg(durationText(telemetry::secondsOf(robot->link->age)));
  }
  if (const auto& penalty = robot->penalty) {
    lines << QStringLiteral("Penalised: %1, %2")
                 .arg(labelText(penalty->kind), durationText(penalty->secondsLeft));
  }
  lines.removeAll(QString());
  return lines.join(QLatin1Char('\n'));
}

QString ballHoverText(const link::MatchFrame& frame) {
  const auto& velocity = frame.snapshot.ballVelocity;
  return QStringLiteral("Ball\nAt %1\nSpeed: %2 m/s")
      .arg(placeText(frame.snapshot.ball), fieldNumber(std::hypot(velocity.x, velocity.y), 2));
}

}  // namespace pitchboard::ui
