// SPDX-License-Identifier: GPL-3.0-or-later
#include "published_vision.h"

#include <algorithm>

#include <base/angles.h>
#include <base/random.h>
#include <simcore/world/published_frame.h>

#include "published_math.h"

namespace pitchboard::sim::published {
namespace {

constexpr double range = 300.0;           // cm
constexpr double halfFieldOfView = 35.0;  // degrees
constexpr double panLimit = 135.0;
constexpr double landmarkHalfView = 90.0;
constexpr double notSeenBearing = -999.0;

/// Strictly less than 90° from straight ahead, by the length of the chord.
bool isAhead(double bearing) {
  static const double limit = [] {
    const UnitVector side(landmarkHalfView);
    const UnitVector front(0.0);
    return std::hypot(side.x - front.x, side.y - front.y);
  }();
  const UnitVector seen(bearing);
  const UnitVector front(0.0);
  return std::hypot(seen.x - front.x, seen.y - front.y) < limit;
}

/// One degree of search; `base` is the body's heading as the limit measures it.
void pan(double& view, bool& panRight, double base) {
  const double before = panRight ? -1.0 : 1.0;
  view = mod360(view + before);
  const double off = mod360(std::abs(base - view));
  if (off > panLimit && off < 360.0 - panLimit) {
    view = mod360(view - before);
    panRight = !panRight;
  }
}

struct Sighting {
  bool seen = false;
  double distance = 0.0;
  double direction = 0.0;  ///< degrees in the window, counter-clockwise
};

Sighting look(const PublishedRobot& robot, double x, double y, double view) {
  Sighting s;
  s.distance = length(robot.x - x, robot.y - y);
  if (!(s.distance < range)) return s;
  // Multiplied before divided, as published; deg() would differ in the last bit.
  s.direction = -(std::atan2(y - robot.y, x - robot.x) * 180.0 / std::numbers::pi);
  const UnitVector centre(view);
  s.seen = chordSquared(UnitVector(s.direction), centre) <
           chordSquared(UnitVector(view + halfFieldOfView), centre);
  return s;
}

/// Heading in (−180, 180] as published: 360 itself stays.
double baseOf(double rotate) {
  return rotate > 180.0 && rotate < 360.0 ? rotate - 360.0 : rotate;
}

double wrapOnce(double bearing) {
  if (bearing > 180.0) return bearing - 360.0;
  if (bearing < -180.0) return bearing + 360.0;
  return bearing;
}

bool pointsAt(double goal, double view) {
  const int whole = wholeMod360(goal);
  return whole >= static_cast<int>(view) - 1 && whole <= static_cast<int>(view) + 1;
}

void lookForBall(WorldState& world, std::size_t index, const RobotCommand& command,
                 Percepts& percepts) {
  PublishedState& state = std::get<PublishedState>(world.physics);
  PublishedRobot& robot = state.robots[index];
  if (command.searchOn == 1) pan(robot.view, robot.panRight, robot.rotate);

  const Sighting ball = look(robot, state.ball.x, state.ball.y, robot.view);
  percepts.ball.lost = ball.seen ? 0 : 1;
  if (!ball.seen) return;
  const double base = baseOf(robot.rotate);
  const double bearing = wrapOnce(ball.direction - base);
  const double goal = std::clamp(bearing, -panLimit, panLimit) + base;
  if (pointsAt(goal, robot.view)) {
    percepts.searchOn = 0;
    percepts.ball.distanceCm = ball.distance;
    percepts.ball.panDeg = bearing;
    robot.view = goal;
    return;
  }
  double reference = robot.view - base;
  if (reference > 180.0) reference -= 360.0;
  robot.panRight = !(reference < bearing);
  pan(robot.view, robot.panRight, base);
}

void lookForRobots(WorldState& world, std::size_t index, bool teamMates, Percepts& percepts) {
  PublishedState& state = std::get<PublishedState>(world.physics);
  PublishedRobot& robot = state.robots[index];
  const NoiseParameters& noise = world.settings.noise;
  CounterRandom random(world.settings.seed, world.robots[index].id.value, NoiseStream::RobotVision,
                       world.tick);
  const TeamColor own = world.robots[index].team;
  for (std::size_t j = 0; j < state.robots.size(); ++j) {
    if (j == index || (world.robots[j].team == own) != teamMates) continue;
    double view = robot.view;
    pan(view, robot.panRight, robot.rotate);
    const Sighting other = look(robot, state.robots[j].x, state.robots[j].y, view);
    percepts.ball.lost = other.seen ? 0 : 1;
    if (!other.seen) continue;
    const double base = baseOf(robot.rotate);
    const double bearing = std::clamp(wrapOnce(other.direction - base), -panLimit, panLimit);
    if (!pointsAt(bearing + base, view)) {
      percepts.searchOn = 1;
      continue;
    }
    percepts.searchOn = 0;
    const double angle = -(bearing + random.normal(0.0, degreesFromRadians(noise.robotBearing)));
    const double distance =
        other.distance + random.normal(0.0, published_frame::cmFromMetres(noise.robotDistance));
    if (j < percepts.robots.size()) percepts.robots[j] = SeenRobot{distance, angle};
  }
}

}  // namespace

void landmarkVision(const WorldState& world, const PublishedGeometry& geometry, std::size_t index,
                    const RobotCommand& command, Percepts& percepts) {
  const PublishedState& state = std::get<PublishedState>(world.physics);
  const PublishedRobot& robot = state.robots[index];
  const NoiseParameters& noise = world.settings.noise;
  const auto bearingOf = [&robot](double x, double y) {
    return -deg(std::atan2(y - robot.y, x - robot.x)) - robot.rotate;
  };
  if (command.localizationLook == 0) {
    double distance = std::hypot(state.ball.x - robot.x, state.ball.y - robot.y);
    double bearing = bearingOf(state.ball.x, state.ball.y);
    if (!isAhead(bearing)) distance = bearing = -1.0;
    CounterRandom random(world.settings.seed, world.robots[index].id.value, NoiseStream::BallVision,
                         world.tick);
    percepts.landmarks.ballTiltDeg = random.normal(distance, distance * noise.visionDistance);
    percepts.landmarks.ballPanDeg = random.normal(bearing, degreesFromRadians(noise.visionBearing));
  } else if (command.localizationLook == 1) {
    CounterRandom random(world.settings.seed, world.robots[index].id.value, NoiseStream::Landmarks,
                         world.tick);
    std::array<double, 4> bearings{};
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      const double bearing = bearingOf(geometry.landmarks[i].x, geometry.landmarks[i].y);
      bearings[i] = isAhead(bearing) && random.uniform() < noise.landmarkProbability
                        ? random.normal(bearing, degreesFromRadians(noise.landmarkBearing))
                        : notSeenBearing;
    }
    percepts.landmarks.bearingsDeg = bearings;
  }
}

void sight(WorldState& world, std::size_t index, const RobotCommand& command, Percepts& percepts) {
  switch (command.actionVision) {
    case 0:
      lookForBall(world, index, command, percepts);
      return;
    case 1:  // ended the published program; its crash is not kept
    case 2:
      lookForRobots(world, index, command.actionVision == 1, percepts);
      return;
    default:
      return;
  }
}

}  // namespace pitchboard::sim::published
