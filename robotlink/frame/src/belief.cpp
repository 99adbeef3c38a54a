// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/belief.h>

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

std::optional<Point> perceivedBall(const sim::FieldSpec& field, const RobotBoardView& board,
                                   const Pose& origin) {
  const double range = sim::published_frame::metresFromCm(static_cast<double>(board.ballDistCm));
  const double bearing = radiansFromDegrees(static_cast<double>(board.panDeg));
  // Beyond twice the field it is no ball, whatever the vision says.
  const bool seen = board.visionWorking && !board.visionLost && range > 0.0 &&
                    range < 2 * field.length && std::isfinite(bearing);
  if (!seen) return {};
  return Point{origin.position.x + range * std::cos(origin.yaw + bearing),
               origin.position.y + range * std::sin(origin.yaw + bearing)};
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
