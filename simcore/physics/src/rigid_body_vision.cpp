// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_vision.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <base/angles.h>
#include <base/random.h>
#include <simcore/world/published_frame.h>

#include "rigid_body_control.h"

namespace pitchboard::sim::rigid {
namespace {

constexpr int lookForBall = 0;
constexpr int lookForTeamMates = 1;
constexpr int lookForOpponents = 2;
constexpr double pointingTolerance = std::numbers::pi / 180.0;  // "±1°", as published
constexpr double landmarkHalfView = std::numbers::pi / 2.0;     // of the body, as published
constexpr double unseenLandmark = -999.0;
constexpr double unseenBall = -1.0;

struct Polar {
  double distance = 0.0;
  double bearing = 0.0;  // from the body's heading, left positive
};

Polar polar(const RigidRobot& robot, double dx, double dy) {
  return {std::sqrt(dx * dx + dy * dy), wrapped(std::atan2(dy, dx) - robot.pose.yaw)};
}

CounterRandom randomOf(const Tick& tick, std::size_t index, NoiseStream stream) {
  return {tick.settings().seed, tick.world.robots[index].id.value, stream, tick.world.tick};
}

/// Where something stands if it is within range and field of view of the head.
std::optional<Polar> inView(const Tick& tick, const RigidRobot& robot, const Point& place) {
  const RigidBodySettings& settings = tick.settings().rigidBody;
  const double dx = place.x - robot.pose.position.x;
  const double dy = place.y - robot.pose.position.y;
  if (dx * dx + dy * dy >= settings.visionRange * settings.visionRange) return {};
  const Polar seen = polar(robot, dx, dy);
  if (std::abs(wrapped(seen.bearing - robot.headYaw)) >= settings.fieldOfView / 2.0) return {};
  return seen;
}

void search(const Tick& tick, RigidRobot& robot) {
  const RigidBodySettings& settings = tick.settings().rigidBody;
  const double step = settings.headSpeed * tick.dt;
  robot.headYaw += robot.panRight ? -step : step;
  if (std::abs(robot.headYaw) < settings.panLimit) return;
  robot.headYaw = std::clamp(robot.headYaw, -settings.panLimit, settings.panLimit);
  robot.panRight = robot.headYaw > 0.0;
}

BallSighting lookAtBall(const Tick& tick, std::size_t index) {
  const RigidRobot& robot = tick.state.robots[index];
  const auto seen = inView(tick, robot, tick.state.ball.position);
  if (!seen) return {};
  const NoiseParameters& noise = tick.settings().noise;
  if (noise.missedDetection == 0.0 && noise.visionDistance == 0.0 && noise.visionBearing == 0.0) {
    return {true, seen->distance, seen->bearing};
  }
  CounterRandom random = randomOf(tick, index, NoiseStream::BallVision);
  if (random.uniform() < noise.missedDetection) return {};
  const double distance =
      std::max(0.0, random.normal(seen->distance, noise.visionDistance * seen->distance));
  return {true, distance, wrapped(random.normal(seen->bearing, noise.visionBearing))};
}

/// Puts a sighting into the ring and takes out the one that the delay has let through.
BallSighting delayed(const Tick& tick, RigidRobot& robot, const BallSighting& now) {
  if (robot.sightings.empty()) return now;
  BallSighting& slot = robot.sightings[tick.world.tick % robot.sightings.size()];
  const BallSighting then = slot;
  slot = now;
  return then;
}

/// Turns the head to what was seen; true when it points there.
bool follow(const Tick& tick, RigidRobot& robot, double bearing) {
  const RigidBodySettings& settings = tick.settings().rigidBody;
  const double goal = std::clamp(bearing, -settings.panLimit, settings.panLimit);
  const double step = settings.headSpeed * tick.dt;
  robot.panRight = goal < robot.headYaw;
  robot.headYaw += std::clamp(goal - robot.headYaw, -step, step);
  return std::abs(goal - robot.headYaw) <= pointingTolerance;
}

void publishBall(const Tick& tick, RigidRobot& robot, const BallSighting& sighting,
                 const RobotCommand& command, Percepts& percept) {
  percept.ball.lost = sighting.seen ? 0 : 1;
  if (!sighting.seen) return;
  percept.ball.distanceCm = published_frame::cmFromMetres(sighting.distance);
  percept.ball.angleDeg = degreesFromRadians(sighting.bearing);
  percept.ball.panDeg = percept.ball.angleDeg;
  if (follow(tick, robot, sighting.bearing) && command.searchOn != 0) percept.searchOn = 0;
}

void lookAtRobots(const Tick& tick, std::size_t index, bool teamMates, Percepts& percept) {
  const RigidRobot& robot = tick.state.robots[index];
  const NoiseParameters& noise = tick.settings().noise;
  CounterRandom random = randomOf(tick, index, NoiseStream::RobotVision);
  const std::size_t most = std::min<std::size_t>(tick.state.robots.size(), Percepts::maxSeenRobots);
  for (std::size_t other = 0; other < most; ++other) {
    const bool mate = tick.world.robots[other].team == tick.world.robots[index].team;
    if (other == index || mate != teamMates) continue;
    const auto seen = inView(tick, robot, tick.state.robots[other].pose.position);
    if (!seen) continue;
    if (noise.missedDetection > 0.0 && random.uniform() < noise.missedDetection) continue;
    const double distance = std::max(0.0, random.normal(seen->distance, noise.robotDistance));
    const double bearing = wrapped(random.normal(seen->bearing, noise.robotBearing));
    percept.robots[other] =
        SeenRobot{published_frame::cmFromMetres(distance), -degreesFromRadians(bearing)};
  }
}

void lookAtCorners(const Tick& tick, std::size_t index, LandmarkPercept& percept) {
  const RigidRobot& robot = tick.state.robots[index];
  const NoiseParameters& noise = tick.settings().noise;
  const double x = tick.settings().field.halfLength();
  const double y = tick.settings().field.halfWidth();
  const std::array<Point, 4> corners{{{-x, y}, {x, y}, {-x, -y}, {x, -y}}};
  CounterRandom random = randomOf(tick, index, NoiseStream::Landmarks);
  std::array<double, 4> bearings{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    bearings[i] = unseenLandmark;
    const Polar corner =
        polar(robot, corners[i].x - robot.pose.position.x, corners[i].y - robot.pose.position.y);
    if (std::abs(corner.bearing) >= landmarkHalfView) continue;
    if (random.uniform() >= noise.landmarkProbability) continue;
    bearings[i] = degreesFromRadians(random.normal(corner.bearing, noise.landmarkBearing));
  }
  percept.bearingsDeg = bearings;
}

/// The published VISION_TILT_DEG: the ball's distance as landmark vision sees it, with the whole
/// front of the body as its view.
void lookAtBallAsLandmark(const Tick& tick, std::size_t index, LandmarkPercept& percept) {
  const RigidRobot& robot = tick.state.robots[index];
  const Motion& motion = tick.motions[index];
  const NoiseParameters& noise = tick.settings().noise;
  const double dx = tick.state.ball.position.x - robot.pose.position.x;
  const double dy = tick.state.ball.position.y - robot.pose.position.y;
  if (dx * motion.heading.cos() + dy * motion.heading.sin() <= 0.0) {
    percept.ballTiltDeg = unseenBall;
    percept.ballPanDeg = unseenBall;
    return;
  }
  const Polar ball = polar(robot, dx, dy);
  CounterRandom random = randomOf(tick, index, NoiseStream::Landmarks);
  const double distance =
      std::max(0.0, random.normal(ball.distance, noise.visionDistance * ball.distance));
  percept.ballTiltDeg = published_frame::cmFromMetres(distance);
  percept.ballPanDeg = degreesFromRadians(random.normal(ball.bearing, noise.visionBearing));
}

void unseenLandmarks(const RobotCommand& command, LandmarkPercept& percept) {
  if (command.localizationLook == 1) {
    percept.bearingsDeg = {unseenLandmark, unseenLandmark, unseenLandmark, unseenLandmark};
  } else if (command.localizationLook == 0) {
    percept.ballTiltDeg = unseenBall;
    percept.ballPanDeg = unseenBall;
  }
}

}  // namespace

std::size_t delayTicks(const SimulationSettings& settings) {
  return static_cast<std::size_t>(std::lround(settings.noise.visionDelay * settings.tickRate));
}

void stepVision(Tick& tick, std::size_t index, const RobotCommand& command, Percepts& percept) {
  RigidRobot& robot = tick.state.robots[index];
  if (isDown(robot)) {
    delayed(tick, robot, {});
    unseenLandmarks(command, percept.landmarks);
    if (command.actionVision == lookForBall) percept.ball.lost = 1;
    return;
  }
  if (command.localizationLook == 1) {
    lookAtCorners(tick, index, percept.landmarks);
  } else if (command.localizationLook == 0) {
    lookAtBallAsLandmark(tick, index, percept.landmarks);
  }

  if (command.searchOn == 1) search(tick, robot);
  const BallSighting sighting = delayed(tick, robot, lookAtBall(tick, index));
  if (command.actionVision == lookForBall) {
    publishBall(tick, robot, sighting, command, percept);
  } else if (command.actionVision == lookForTeamMates) {
    lookAtRobots(tick, index, true, percept);
  } else if (command.actionVision == lookForOpponents) {
    lookAtRobots(tick, index, false, percept);
  }
}

}  // namespace pitchboard::sim::rigid
