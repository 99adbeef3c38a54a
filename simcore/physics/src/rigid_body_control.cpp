// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_control.h"

#include <algorithm>

#include <base/angles.h>
#include <base/random.h>
#include <simcore/world/action.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::sim::rigid {
namespace {

constexpr int getUpFromFront = 15;
constexpr int getUpFromBack = 16;
constexpr int walkSlow = 8;
constexpr int leastFixedB = 10;         // from here on action 8 walks at the speed of the table
constexpr double slowStep = 0.015;      // cm per frame for each unit of DECISION_ACTION_B
constexpr double strongestKick = 10.0;  // cm per frame

struct Speeds {
  double forward = 0.0;   // m/s
  double sideways = 0.0;  // m/s, left
  double turn = 0.0;      // rad/s
};

Speeds speedsOf(const RigidRobot& robot) {
  if (!robot.inMotion) return {};
  const Action* action = findAction(robot.action);
  if (!action) return {};
  double front = action->front;
  if (robot.action == walkSlow && robot.actionB < leastFixedB) front = slowStep * robot.actionB;
  return {published_frame::mpsFromCmPerFrame(front),
          published_frame::mpsFromCmPerFrame(action->drift),
          radiansFromDegrees(action->turn) * published_frame::framesPerSecond};
}

double approach(double value, double target, double most) {
  return value < target ? std::min(value + most, target) : std::max(value - most, target);
}

void select(RigidRobot& robot, int code, int b, bool inMotion) {
  robot.action = code;
  robot.actionB = b;
  robot.inMotion = inMotion;
}

void kick(Tick& tick, std::size_t index, const Action& action) {
  const RigidRobot& robot = tick.state.robots[index];
  RigidBall& ball = tick.state.ball;
  const KickRule& rule = action.kick;
  const double dx = ball.position.x - robot.pose.position.x;
  const double dy = ball.position.y - robot.pose.position.y;
  const double bearing = degreesFromRadians(wrapped(std::atan2(dy, dx) - robot.pose.yaw));
  if (bearing <= -rule.rightLimit || bearing >= rule.leftLimit) return;

  const double distance_cm = published_frame::cmFromMetres(std::sqrt(dx * dx + dy * dy));
  const double reach_cm = published_frame::cmFromMetres(tick.settings().field.robotRadius);
  const double gap = (reach_cm - distance_cm) / rule.strength;
  const double force = std::min(strongestKick, rule.strength * std::exp(-gap * gap)) * rule.share;
  if (force < leastKickForce) return;

  const NoiseParameters& noise = tick.settings().noise;
  CounterRandom random(tick.settings().seed, tick.world.robots[index].id.value, NoiseStream::Kick,
                       tick.world.tick);
  const double speed =
      std::max(0.0, random.normal(published_frame::mpsFromCmPerFrame(force), noise.kickSpeed));
  const double direction =
      random.normal(robot.pose.yaw + radiansFromDegrees(rule.direction), noise.kickAngle);
  ball.velocity = {speed * std::cos(direction), speed * std::sin(direction)};
  ++tick.world.statistics[index].kicks;
  tick.report(EventKind::Kick, index, action.code);
}

void selectUpright(Tick& tick, std::size_t index, const RobotCommand& command,
                   ControlPercept& percept) {
  RigidRobot& robot = tick.state.robots[index];
  const int code = command.actionA;
  const Action* action = findAction(code);
  if (!action) {
    select(robot, code, command.actionB, false);
    RobotStatistics& statistics = tick.world.statistics[index];
    ++statistics.unknownActions;
    statistics.lastUnknownAction = code;
    tick.report(EventKind::UnknownAction, index, code);
    return;
  }
  switch (action->kind) {
    case ActionKind::Stop:
    case ActionKind::GetUp:  // nothing to do for a robot that stands
      select(robot, code, command.actionB, false);
      break;
    case ActionKind::Walk:
    case ActionKind::InPlace:
      select(robot, code, command.actionB, true);
      break;
    case ActionKind::Kick:
      kick(tick, index, *action);
      select(robot, 0, 0, false);
      percept.finishedAction = code;
      break;
  }
}

void beginGettingUp(RigidRobot& robot, double time) {
  select(robot, liesOnFront(robot) ? getUpFromFront : getUpFromBack, 0, false);
  robot.posture = Posture::GettingUp;
  robot.getUpRemaining = time;
}

void stepDown(Tick& tick, std::size_t index, const RobotCommand& command, ControlPercept& percept) {
  RigidRobot& robot = tick.state.robots[index];
  if (robot.posture != Posture::GettingUp) {
    robot.getUpRemaining -= tick.dt;
    const int right = liesOnFront(robot) ? getUpFromFront : getUpFromBack;
    if (command.actionA == right || robot.getUpRemaining <= 0.0) {
      beginGettingUp(robot, tick.settings().rigidBody.getUpTime);
    }
    return;
  }
  robot.getUpRemaining -= tick.dt;
  if (robot.getUpRemaining > 0.0) return;
  if (command.actionA == robot.action) percept.finishedAction = robot.action;
  robot.posture = Posture::Upright;
  robot.getUpRemaining = 0.0;
  select(robot, 0, 0, false);
  tick.report(EventKind::GotUp, index);
}

/// Motion noise of one tick: displacement along and across the heading and turn.
struct MotionNoise {
  double forward = 0.0, sideways = 0.0, turn = 0.0;
};

MotionNoise drawNoise(const Tick& tick, std::size_t index) {
  const NoiseParameters& noise = tick.settings().noise;
  if (!tick.state.robots[index].inMotion) return {};
  if (noise.forward == 0.0 && noise.sideways == 0.0 && noise.rotation == 0.0) return {};
  CounterRandom random(tick.settings().seed, tick.world.robots[index].id.value, NoiseStream::Motion,
                       tick.world.tick);
  // One statement each: the published order is rotation, forward, sideways.
  MotionNoise drawn;
  drawn.turn = random.normal(0.0, noise.rotation * tick.sqrtFrames);
  drawn.forward = random.normal(0.0, noise.forward * tick.sqrtFrames);
  drawn.sideways = random.normal(0.0, noise.sideways * tick.sqrtFrames);
  return drawn;
}

void setMotion(Tick& tick, std::size_t index) {
  const RigidBodySettings& settings = tick.settings().rigidBody;
  RigidRobot& robot = tick.state.robots[index];
  Motion& motion = tick.motions[index];
  const Speeds target = speedsOf(robot);
  const double gain = settings.maxAcceleration * tick.dt;
  motion.forward = robot.forwardSpeed;
  motion.sideways = robot.sidewaysSpeed;
  robot.forwardSpeed = approach(robot.forwardSpeed, target.forward, gain);
  robot.sidewaysSpeed = approach(robot.sidewaysSpeed, target.sideways, gain);
  robot.yawRate = approach(robot.yawRate, target.turn, settings.maxYawAcceleration * tick.dt);

  const MotionNoise noise = drawNoise(tick, index);
  motion.turned = robot.yawRate * tick.dt + noise.turn;
  robot.pose.yaw = wrapped(robot.pose.yaw + motion.turned);
  motion.heading.set(robot.pose.yaw);
  const double c = motion.heading.cos();
  const double s = motion.heading.sin();
  motion.velocity = {c * robot.forwardSpeed - s * robot.sidewaysSpeed,
                     s * robot.forwardSpeed + c * robot.sidewaysSpeed};
  motion.noise = {c * noise.forward - s * noise.sideways, s * noise.forward + c * noise.sideways};
  motion.impulse = {};
}

}  // namespace

bool liesOnFront(const RigidRobot& robot) {
  return robot.posture == Posture::OnFront ||
         (robot.posture == Posture::GettingUp && robot.action == getUpFromFront);
}

void stepControl(Tick& tick, std::size_t index, const RobotCommand& command, Percepts& percept) {
  RigidRobot& robot = tick.state.robots[index];
  percept.control.action = command.actionA;
  if (isDown(robot)) {
    stepDown(tick, index, command, percept.control);
    // Localization must not believe that a robot on the ground walks.
    percept.control.action = robot.action;
  } else if (robot.action != command.actionA) {
    selectUpright(tick, index, command, percept.control);
  }
  percept.control.moving = robot.inMotion || robot.posture == Posture::GettingUp ? 1 : 0;
  setMotion(tick, index);
}

void applyFall(Tick& tick, std::size_t index) {
  RigidRobot& robot = tick.state.robots[index];
  if (isDown(robot)) return;
  const Motion& motion = tick.motions[index];
  const Velocity& hit = motion.impulse;
  const double most = tick.settings().rigidBody.fallImpulse;
  if (hit.x * hit.x + hit.y * hit.y <= most * most) return;
  const double along = hit.x * motion.heading.cos() + hit.y * motion.heading.sin();
  robot.posture = along > 0.0 ? Posture::OnFront : Posture::OnBack;
  robot.getUpRemaining = lyingTime;
  select(robot, 0, 0, false);
  ++tick.world.statistics[index].falls;
  tick.report(EventKind::Fall, index);
}

}  // namespace pitchboard::sim::rigid
