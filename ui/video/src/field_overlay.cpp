// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_overlay.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include <ui/base/field_ground.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QPointF atField(const Point& point) {
  return {point.x, point.y};
}

/// The third row of the projection: positive in front of the camera.
double depthAt(const QTransform& transform, const QPointF& p) {
  return transform.m13() * p.x() + transform.m23() * p.y() + transform.m33();
}

QTransform scaledBy(const QTransform& t, double factor) {
  return {t.m11() * factor, t.m12() * factor, t.m13() * factor, t.m21() * factor, t.m22() * factor,
          t.m23() * factor, t.m31() * factor, t.m32() * factor, t.m33() * factor};
}

QPainterPath linesOf(const sim::FieldSpec& field) {
  const sim::FieldLines lines = sim::fieldLines(field, field.lineWidth);
  QPainterPath path;
  path.setFillRule(Qt::WindingFill);
  for (const auto& line : lines.lines) path.addRect(rectOf(line));
  for (const auto& goal : lines.goals) {
    // Its outline, as thick as a line.
    QPainterPath outline;
    outline.addRect(rectOf(goal));
    QPainterPathStroker stroker;
    stroker.setWidth(field.lineWidth);
    path.addPath(stroker.createStroke(outline));
  }
  if (lines.circleRadius > 0.0) {
    QPainterPath circle;
    circle.addEllipse(QPointF(), lines.circleRadius, lines.circleRadius);
    QPainterPathStroker stroker;
    stroker.setWidth(field.lineWidth);
    path.addPath(stroker.createStroke(circle));
  }
  const double mark = std::max(lines.markRadius, field.lineWidth);
  path.addEllipse(QPointF(), mark, mark);
  for (const Point& place : lines.marks) path.addEllipse(atField(place), mark, mark);
  return path;
}

QPainterPath discAt(const QPointF& place, double radius) {
  QPainterPath path;
  path.addEllipse(place, radius, radius);
  return path;
}

void paintLabel(QPainter& painter, const QPointF& at, const QString& text) {
  const QFontMetricsF metrics(painter.font());
  const QPointF left(at.x() - metrics.horizontalAdvance(text) / 2, at.y());
  QPainterPath letters;
  letters.addText(left, painter.font(), text);
  painter.strokePath(letters,
                     QPen(QColor(0, 0, 0, 200), 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.fillPath(letters, Qt::white);
}

void paintRobot(QPainter& painter, const QTransform& toPicture, const link::RobotFrame& robot,
                const link::MatchFrame& frame) {
  const QPointF place = atField(robot.pose.position);
  if (!robot.poseKnown() || depthAt(toPicture, place) <= 0.0) return;
  const double radius = robot.radius > 0.0 ? robot.radius : frame.settings->field.robotRadius;
  const auto team = link::colourAt(robot.key.team, frame.teams);
  const QColor colour = team ? theme().team(*team) : QColor(Qt::lightGray);
  QColor fill = colour;
  fill.setAlpha(90);
  const QPainterPath disc = toPicture.map(discAt(place, radius));
  // Dashed as the belief of a robot: the picture shows where it really is.
  painter.setPen(QPen(colour, 2.0, frame.truthKnown ? Qt::SolidLine : Qt::DashLine));
  painter.setBrush(fill);
  painter.drawPath(disc);
  const QPointF nose =
      place + 1.6 * radius * QPointF(std::cos(robot.pose.yaw), std::sin(robot.pose.yaw));
  if (depthAt(toPicture, nose) > 0.0) {
    painter.setPen(QPen(colour, 2.5));
    painter.drawLine(toPicture.map(place), toPicture.map(nose));
  }
  paintLabel(painter,
             QPointF(toPicture.map(place).x(),
                     disc.boundingRect().bottom() + QFontMetricsF(painter.font()).ascent()),
             QString::fromStdString(robot.name));
}

}  // namespace

std::vector<FieldMark> fieldMarks(const sim::FieldSpec& field) {
  const double x = field.halfLength(), y = field.halfWidth();
  std::vector<FieldMark> marks{{QStringLiteral("Top left corner"), {-x, y}},
                               {QStringLiteral("Top right corner"), {x, y}},
                               {QStringLiteral("Bottom right corner"), {x, -y}},
                               {QStringLiteral("Bottom left corner"), {-x, -y}},
                               {QStringLiteral("Centre line, top end"), {0, y}},
                               {QStringLiteral("Centre line, bottom end"), {0, -y}},
                               {QStringLiteral("Centre mark"), {0, 0}}};
  for (const double side : {-1.0, 1.0}) {
    const QString name = side < 0 ? QStringLiteral("Left") : QStringLiteral("Right");
    marks.push_back(
        {name + QStringLiteral(" penalty mark"), {side * (x - field.penaltyMarkDistance), 0}});
    const auto area = [&](const char* what, double length, double width) {
      if (length <= 0.0) return;
      marks.push_back({name + QStringLiteral(" %1 area, top corner").arg(QLatin1String(what)),
                       {side * (x - length), width / 2}});
      marks.push_back({name + QStringLiteral(" %1 area, bottom corner").arg(QLatin1String(what)),
                       {side * (x - length), -width / 2}});
    };
    area("goal", field.goalAreaLength, field.goalAreaWidth);
    area("penalty", field.penaltyAreaLength, field.penaltyAreaWidth);
    marks.push_back({name + QStringLiteral(" goal, top post"), {side * x, field.goalWidth / 2}});
    marks.push_back(
        {name + QStringLiteral(" goal, bottom post"), {side * x, -field.goalWidth / 2}});
  }
  return marks;
}

std::optional<QTransform> groundToPicture(std::span<const telemetry::VideoLandmark> landmarks) {
  if (landmarks.size() != 4) return {};
  QPolygonF field, picture;
  for (const telemetry::VideoLandmark& mark : landmarks) {
    field << atField(mark.field);
    picture << atField(mark.picture);
  }
  QTransform projection;
  if (!QTransform::quadToQuad(field, picture, projection)) return {};
  const double depth = depthAt(projection, atField(landmarks.front().field));
  if (!std::isfinite(depth) || std::abs(projection.determinant()) < 1e-12 || depth == 0.0) {
    return {};
  }
  // The projection is the same with the other sign, but Qt leaves out what has a negative depth.
  projection = scaledBy(projection, 1.0 / depth);
  for (const telemetry::VideoLandmark& mark : landmarks) {
    const QPointF place = atField(mark.field);
    // All four are seen, so all must be in front of the camera.
    if (depthAt(projection, place) <= 0.0) return {};
    const QPointF off = projection.map(place) - atField(mark.picture);
    if (!(std::hypot(off.x(), off.y()) < 1e-3)) return {};
  }
  return projection;
}

void paintOverlay(QPainter& painter, const QTransform& toPicture, const link::MatchFrame& frame) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QPainterPath lines = toPicture.map(linesOf(frame.settings->field));
  // White on the white lines of the picture would not be seen.
  QColor inside = theme().accentLine;
  inside.setAlpha(150);
  painter.setPen(QPen(theme().accentLine, 1.0));
  painter.setBrush(inside);
  painter.drawPath(lines);
  painter.setFont(themeFont(TypeRole::Secondary, true));
  for (const link::RobotFrame& robot : frame.robots) paintRobot(painter, toPicture, robot, frame);
  const QPointF ball = atField(frame.snapshot.ball);
  if (frame.ballKnown && depthAt(toPicture, ball) > 0.0) {
    painter.setPen(QPen(Qt::black, 1.5));
    painter.setBrush(theme().ball);
    painter.drawPath(toPicture.map(discAt(ball, frame.settings->field.ballRadius)));
  }
  painter.restore();
}

void paintOverlay(QPainter& painter, const QTransform& groundToPicture, const QRectF& rect,
                  const link::MatchFrame& frame) {
  painter.save();
  painter.setClipRect(rect);
  paintOverlay(painter,
               groundToPicture * QTransform::fromScale(rect.width(), rect.height()) *
                   QTransform::fromTranslate(rect.left(), rect.top()),
               frame);
  painter.restore();
}

}  // namespace pitchboard::ui
