// SPDX-License-Identifier: GPL-3.0-or-later
#include "published_motion.h"

#include <algorithm>

#include <base/angles.h>
#include <base/random.h>
#include <simcore/world/action.h>
#include <simcore/world/published_frame.h>

#include "published_math.h"

namespace pitchboard::sim::published {
namespace {

PublishedState& stateOf(WorldState& world) {
  return std::get<PublishedState>(world.physics);
}

void setInMotion(PublishedBall& ball, double speed, double angle) {
  ball.vx = speed * std::cos(rad(angle));
  ball.vy = -speed * std::sin(rad(angle));
}

/// Does a circle at (along, across) of the line's own axes overlap it?
bool touches(const PublishedLine& line, double along, double across, double radius) {
  return line.from < along + radius && line.to > along - radius &&
         std::abs(line.at - across) < radius;
}

void pushFromLines(const PublishedGeometry& geometry, PublishedRobot& robot) {
  constexpr double push = 3.0;
  for (const PublishedLine& line : geometry.lines) {
    const double along = line.horizontal ? robot.x : robot.y;
    double& across = line.horizontal ? robot.y : robot.x;
    if (!touches(line, along, across, geometry.robotRadius)) continue;
    if (line.at > across) {
      across -= push;
    } else if (line.at < across) {
      across += push;
    }
  }
}

void pushFromPosts(const PublishedGeometry& geometry, PublishedRobot& robot) {
  for (const PublishedPoint& post : geometry.posts) {
    const double dx = robot.x - post.x;
    const double dy = robot.y - post.y;
    if (isShorter(dx, dy, geometry.robotRadius + geometry.postRadius)) {
      const double angle = std::atan2(dy, dx);
      robot.x += 3.0 * std::cos(angle);
      robot.y += 3.0 * std::sin(angle);
    }
  }
}

void pushRobotsApart(const PublishedGeometry& geometry, std::vector<PublishedRobot>& robots,
                     std::size_t index) {
  PublishedRobot& robot = robots[index];
  for (std::size_t other = 0; other < robots.size(); ++other) {
    if (other == index) continue;
    PublishedRobot& hit = robots[other];
    const double dx = robot.x - hit.x;
    const double dy = robot.y - hit.y;
    if (isShorter(dx, dy, 2 * geometry.robotRadius)) {
      const double rho = std::atan2(dy, dx);
      hit.x += std::cos(rho + std::numbers::pi);
      hit.y += std::sin(rho + std::numbers::pi);
      robot.x += 2.0 * std::cos(rho);
      robot.y += 2.0 * std::sin(rho);
    }
  }
}

void pushBall(const PublishedGeometry& geometry, const PublishedRobot& robot, PublishedBall& ball) {
  const double dx = ball.x - robot.x;
  const double dy = robot.y - ball.y;
  if (!isShorter(dx, dy, geometry.robotRadius + geometry.ballRadius)) return;
  const double rho = std::atan2(dy, dx);
  const double speed = length(ball.vx, ball.vy);
  const double beta = std::atan2(ball.vy, ball.vx);
  const double along = speed * std::cos(beta - rho) + 1.0;
  const double across = speed * std::sin(beta - rho);
  setInMotion(ball, length(along, across), deg(std::atan2(across, along) + rho));
}

/// One of the two draws a frame by which the orientation error grows.
void growOrientationError(const WorldState& world, std::size_t index, std::uint64_t draw,
                          PublishedRobot& robot) {
  const double sigma = world.settings.noise.imuDrift;
  if (sigma == 0.0) return;
  CounterRandom random(world.settings.seed, world.robots[index].id.value, NoiseStream::Imu,
                       2 * world.tick + draw);
  robot.orientationError += random.normal(0.0, degreesFromRadians(sigma));
}

/// Publishes CONTROL_MOVING and takes the action's speeds; kicks act at once.
class Selection {
 public:
  Selection(WorldState& world, const PublishedGeometry& geometry, std::size_t index,
            Percepts& percepts, std::vector<Event>& events)
      : m_world(world),
        m_geometry(geometry),
        m_index(index),
        m_robot(stateOf(world).robots[index]),
        m_percepts(percepts),
        m_events(events) {}

  void select(const RobotCommand& command) {
    const Action* action = findAction(command.actionA);
    if (!action || !action->inPublishedModel) {
      countUnknown(command.actionA);
      stop(command.actionA);
      return;
    }
    switch (action->kind) {
      case ActionKind::Stop:
        stop(command.actionA);
        return;
      case ActionKind::Kick:
        kick(*action);
        stop(command.actionA);
        return;
      default:
        walk(*action, command.actionB);
    }
  }

 private:
  void stop(int finishedAction) {
    m_robot.action = 0;
    m_robot.inMotion = false;
    m_robot.front = m_robot.turn = m_robot.drift = 0.0;
    m_percepts.control.moving = 0;
    m_percepts.control.finishedAction = finishedAction;
  }

  void walk(const Action& action, int actionB) {
    constexpr int slowWalk = 8;
    constexpr double stepFactor = 0.015;
    m_robot.action = action.code;
    m_robot.inMotion = true;
    m_robot.front = action.code == slowWalk && actionB < 10 ? stepFactor * actionB : action.front;
    m_robot.turn = action.turn;
    m_robot.drift = action.drift;
    m_percepts.control.moving = 1;
  }

  void kick(const Action& action) {
    const KickRule& rule = action.kick;
    PublishedBall& ball = stateOf(m_world).ball;
    const double rotate = m_robot.rotate;
    const double left = rule.leftLimit;
    const double right = rule.rightLimit;
    double direction = deg(std::atan2(m_robot.y - ball.y, ball.x - m_robot.x));
    if (direction < 0.0) direction += 360.0;
    const bool inSector =
        (rotate > 360.0 - left &&
         (direction > rotate - right || direction < rotate - 360.0 + left)) ||
        (rotate < right && (direction > 360.0 - right + rotate || direction < rotate + left)) ||
        (direction > rotate - right && direction < rotate + left);
    if (!inSector) return;

    const double gap = m_geometry.robotRadius - length(m_robot.x - ball.x, m_robot.y - ball.y);
    const double strength = rule.strength;
    double force =
        std::min(10.0, strength * std::exp(-square(gap) / square(strength))) * rule.share;
    double angle = rotate + rule.direction;
    const NoiseParameters& noise = m_world.settings.noise;
    if (noise.kickSpeed > 0.0 || noise.kickAngle > 0.0) {
      CounterRandom random(m_world.settings.seed, id().value, NoiseStream::Kick, m_world.tick);
      force += random.normal(0.0, published_frame::cmPerFrameFromMps(noise.kickSpeed));
      angle += random.normal(0.0, degreesFromRadians(noise.kickAngle));
    }
    setInMotion(ball, force, angle);
    ++m_world.statistics[m_index].kicks;
    m_events.push_back({EventKind::Kick, m_world.tick, id(), action.code});
  }

  void countUnknown(int code) {
    RobotStatistics& statistics = m_world.statistics[m_index];
    ++statistics.unknownActions;
    statistics.lastUnknownAction = code;
    m_events.push_back({EventKind::UnknownAction, m_world.tick, id(), code});
  }

  RobotId id() const { return m_world.robots[m_index].id; }

  WorldState& m_world;
  const PublishedGeometry& m_geometry;
  std::size_t m_index;
  PublishedRobot& m_robot;
  Percepts& m_percepts;
  std::vector<Event>& m_events;
};

}  // namespace

void moveRobot(WorldState& world, const PublishedGeometry& geometry, std::size_t index) {
  PublishedState& state = stateOf(world);
  PublishedRobot& robot = state.robots[index];
  double turn = robot.turn;
  double front = robot.front;
  double drift = robot.drift;
  const NoiseParameters& noise = world.settings.noise;
  if (robot.inMotion && (noise.rotation > 0.0 || noise.forward > 0.0 || noise.sideways > 0.0)) {
    CounterRandom random(world.settings.seed, world.robots[index].id.value, NoiseStream::Motion,
                         world.tick);
    turn += random.normal(0.0, degreesFromRadians(noise.rotation));
    front += random.normal(0.0, published_frame::cmFromMetres(noise.forward));
    drift += random.normal(0.0, published_frame::cmFromMetres(noise.sideways));
  }

  robot.rotate = mod360(robot.rotate + turn);
  robot.view = mod360(robot.view + turn);
  const double cosine = std::cos(rad(robot.rotate));
  const double sine = std::sin(rad(robot.rotate));
  robot.x += cosine * front;
  robot.y -= sine * front;
  robot.x -= sine * drift;
  robot.y -= cosine * drift;
  world.statistics[index].distanceWalked +=
      published_frame::metresFromCm(std::hypot(robot.front, robot.drift));

  pushFromLines(geometry, robot);
  pushFromPosts(geometry, robot);
  pushRobotsApart(geometry, state.robots, index);
  pushBall(geometry, robot, state.ball);
  growOrientationError(world, index, 0, robot);
}

void controlRobot(WorldState& world, const PublishedGeometry& geometry, std::size_t index,
                  const RobotCommand& command, Percepts& percepts, std::vector<Event>& events) {
  PublishedRobot& robot = stateOf(world).robots[index];
  double orientation = robot.rotate;
  if (world.robots[index].imuStartsAt180) {
    orientation -= 180.0;
  } else if (orientation > 180.0) {
    orientation -= 360.0;
  }
  growOrientationError(world, index, 1, robot);
  if (robot.orientationError != 0.0) orientation += robot.orientationError;
  percepts.imu.eulerZ = rad(orientation);
  percepts.control.action = command.actionA;
  percepts.decisionWorking = true;

  const bool walkingOtherwise = robot.action != 0 && robot.action != command.actionA;
  if (robot.action == 0 || walkingOtherwise) {
    Selection(world, geometry, index, percepts, events).select(command);
  }
}

BallSweep moveBall(WorldState& world, const PublishedGeometry& geometry) {
  PublishedBall& ball = stateOf(world).ball;
  const FieldSpec& field = world.settings.field;
  BallSweep sweep;
  sweep.from = published_frame::studioFromWindow(field, ball.x, ball.y);
  ball.vx *= ball.friction;
  ball.vy *= ball.friction;
  ball.x += ball.vx;
  ball.y += ball.vy;
  sweep.aim = published_frame::studioFromWindow(field, ball.x, ball.y);
  for (const PublishedPoint& post : geometry.posts) {
    if (isShorter(ball.x - post.x, ball.y - post.y, geometry.ballRadius + geometry.postRadius)) {
      setInMotion(ball, length(ball.vx, ball.vy),
                  deg(std::atan2(post.y - ball.y, ball.x - post.x)));
    }
  }
  for (const PublishedLine& line : geometry.lines) {
    const bool touched = line.horizontal ? touches(line, ball.x, ball.y, geometry.ballRadius)
                                         : touches(line, ball.y, ball.x, geometry.ballRadius);
    if (!touched) continue;
    double& across = line.horizontal ? ball.vy : ball.vx;
    across = -across;
  }
  return sweep;
}

}  // namespace pitchboard::sim::published
