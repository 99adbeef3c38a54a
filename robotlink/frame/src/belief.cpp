// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/belief.h>

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {

std::optional<Pose> believedPose(const sim::FieldSpec& field, const RobotBoardView& board) {
  if (!board.localizationWorking) return {};
  return sim::published_frame::studioFromLocalization(
      field, {static_cast<double>(board.localizationX), static_cast<double>(board.localizationY),
              static_cast<double>(board.localizationTheta)});
}

std::optional<Point> ballSeenFrom(const Pose& origin, double distance_cm, double bearing_deg,
                                  const sim::FieldSpec& field) {
  const double range = sim::published_frame::metresFromCm(distance_cm);
  // Beyond twice the field it is no ball, whatever the vision says.
  if (!(range > 0.0) || !(range < 2 * field.length) || !std::isfinite(bearing_deg)) return {};
  const double direction = origin.yaw + radiansFromDegrees(std::fmod(bearing_deg, 360.0));
  return Point{origin.position.x + range * std::cos(direction),
               origin.position.y + range * std::sin(direction)};
}

Pose perceivingPose(const sim::FieldSpec& field, const RobotFrame& robot) {
  if (!robot.board || robot.health) return robot.pose;
  return believedPose(field, *robot.board).value_or(robot.pose);
}

std::optional<Point> perceivedBall(const sim::FieldSpec& field, const RobotFrame& robot) {
  if (robot.health) return robot.timedOut() ? std::nullopt : robot.health->ball;
  if (!robot.board || !robot.board->visionWorking || robot.board->visionLost) return {};
  return ballSeenFrom(perceivingPose(field, robot), static_cast<double>(robot.board->ballDistCm),
                      static_cast<double>(robot.board->panDeg), field);
}

std::optional<telemetry::Battery> batteryOf(const RobotFrame& robot) {
  if (robot.health) return robot.health->battery;
  if (!robot.board || robot.board->voltage <= 0) return {};
  return telemetry::batteryAt(robot.board->voltage / 10.0, telemetry::usualBattery);
}

std::optional<TeamBall> agreedBall(const std::vector<Point>& balls) {
  const auto near = [](const Point& a, const Point& b) {
    return distance(a, b) <= TeamBall::reach;
  };
  const Point* centre = nullptr;
  int most = 1;
  for (const Point& ball : balls) {
    const auto count = static_cast<int>(
        std::count_if(balls.begin(), balls.end(), [&](const Point& b) { return near(ball, b); }));
    if (count > most) {
      most = count;
      centre = &ball;
    }
  }
  if (centre == nullptr) return std::nullopt;
  TeamBall agreed;
  agreed.see = static_cast<int>(balls.size());
  agreed.agree = most;
  for (const Point& ball : balls) {
    if (!near(*centre, ball)) continue;
    agreed.position.x += ball.x / most;
    agreed.position.y += ball.y / most;
  }
  double squares = 0.0;
  for (const Point& ball : balls) {
    if (!near(*centre, ball)) continue;
    const double dx = ball.x - agreed.position.x, dy = ball.y - agreed.position.y;
    squares += dx * dx + dy * dy;
  }
  agreed.spread = std::sqrt(squares / most);
  return agreed;
}

}  // namespace pitchboard::link
