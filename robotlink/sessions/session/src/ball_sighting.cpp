// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/ball_sighting.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <robotlink/frame/build_robot.h>

namespace pitchboard::link {
namespace {

constexpr double ballSigmaPerMetre = 0.08;

}  // namespace

std::optional<BallSighting> ballSeenIn(const MatchFrame& frame) {
  std::vector<RobotFrame> sure;
  for (const RobotFrame& robot : frame.robots) {
    if (robot.belief && robot.ball && !robot.timedOut()) sure.push_back(robot);
  }
  if (sure.empty()) return {};
  const auto nearest = std::ranges::min_element(
      sure, {}, [](const RobotFrame& robot) { return robot.ball->distance; });
  BallSighting seen;
  seen.place = nearest->ball->place;
  seen.sigma = std::hypot(nearest->sigma.value_or(unknownSigma),
                          std::max(minBallSigma, ballSigmaPerMetre * nearest->ball->distance));
  const std::vector<TeamBall> balls = agreedBalls(sure);
  const auto agreed = std::ranges::max_element(balls, {}, &TeamBall::agree);
  if (agreed != balls.end()) {
    seen.place = agreed->position;
    seen.sigma = std::max(minBallSigma, agreed->spread);
  }
  if (!std::isfinite(seen.place.x) || !std::isfinite(seen.place.y)) return {};
  return seen;
}

}  // namespace pitchboard::link
