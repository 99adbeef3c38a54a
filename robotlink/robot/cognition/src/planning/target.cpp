// SPDX-License-Identifier: GPL-3.0-or-later
#include "planning/target.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <base/angles.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

namespace frame = sim::published_frame;

double value(const Blackboard& board, FloatVar variable) {
  return static_cast<double>(board.read(variable));
}

}  // namespace

bool Target::isReached(const Pose& at) const {
  return distance(at.position, pose.position) < near &&
         std::abs(wrapToPi(pose.yaw - at.yaw)) < facing;
}

TargetVariables::TargetVariables() {
  const VariableCatalog& map = VariableCatalog::extended();
  const auto floatVar = [&map](const char* name) { return map.floatVar(name).value(); };
  m_wanted = map.intVar("DECISION_TARGET").value();
  m_pathPoints = map.intVar("PLANNING_PATH_POINTS").value();
  m_x = floatVar("DECISION_TARGET_X");
  m_y = floatVar("DECISION_TARGET_Y");
  m_theta = floatVar("DECISION_TARGET_THETA");
  m_near = floatVar("DECISION_TARGET_NEAR");
  m_facing = floatVar("DECISION_TARGET_FACING");
  m_ballX = floatVar("DECISION_TARGET_BALL_X");
  m_ballY = floatVar("DECISION_TARGET_BALL_Y");
  for (std::size_t i = 0; i < m_pathX.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "PLANNING_PATH%02d_X", static_cast<int>(i) + 1);
    m_pathX[i] = floatVar(name);
    std::snprintf(name, sizeof name, "PLANNING_PATH%02d_Y", static_cast<int>(i) + 1);
    m_pathY[i] = floatVar(name);
  }
}

void TargetVariables::write(Blackboard& board, const sim::FieldSpec& field,
                            const Target& target) const {
  const auto put = [&board](FloatVar variable, double number) {
    board.write(variable, static_cast<float>(number));
  };
  const frame::CmPose pose = frame::localizationFromStudio(field, target.pose);
  put(m_x, pose.x);
  put(m_y, pose.y);
  put(m_theta, pose.degrees);
  put(m_near, frame::cmFromMetres(target.near));
  put(m_facing, degreesFromRadians(target.facing));
  if (target.ball) {
    const frame::CmPose ball = frame::localizationFromStudio(field, {*target.ball, 0.0});
    put(m_ballX, ball.x);
    put(m_ballY, ball.y);
  }
  board.write(m_wanted, (target.ball ? roundBall : walk) + (target.forwards ? forwards : none) +
                            (target.apart ? apart : none));
}

std::optional<Target> TargetVariables::read(const Blackboard& board,
                                            const sim::FieldSpec& field) const {
  const int all = board.read(m_wanted);
  const int wanted = all & (walk | roundBall);
  if ((wanted != walk && wanted != roundBall) || (all & ~(wanted | forwards | apart)) != 0) {
    return std::nullopt;
  }
  Target target;
  target.forwards = (all & forwards) != 0;
  target.apart = (all & apart) != 0;
  target.pose = frame::studioFromLocalization(
      field, {value(board, m_x), value(board, m_y), value(board, m_theta)});
  target.near = frame::metresFromCm(value(board, m_near));
  target.facing = radiansFromDegrees(value(board, m_facing));
  for (const double number : {target.pose.position.x, target.pose.position.y, target.pose.yaw,
                              target.near, target.facing}) {
    if (!std::isfinite(number)) return std::nullopt;
  }
  if (wanted == roundBall) {
    const Point ball =
        frame::studioFromLocalization(field, {value(board, m_ballX), value(board, m_ballY), 0.0})
            .position;
    if (std::isfinite(ball.x) && std::isfinite(ball.y)) target.ball = ball;
  }
  return target;
}

void TargetVariables::writePath(Blackboard& board, const sim::FieldSpec& field,
                                std::span<const Point> points) const {
  const std::size_t count = std::min(points.size(), m_pathX.size());
  for (std::size_t i = 0; i < count; ++i) {
    const frame::CmPose cm = frame::localizationFromStudio(field, {points[i], 0.0});
    board.write(m_pathX[i], static_cast<float>(cm.x));
    board.write(m_pathY[i], static_cast<float>(cm.y));
  }
  board.write(m_pathPoints, static_cast<int>(count));
}

}  // namespace pitchboard::link
