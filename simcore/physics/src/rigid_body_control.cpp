// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_control.h"

#include <algorithm>

#include <base/angles.h>
#include <base/random.h>
#include <simcore/world/action.h>
#include <simcore/world/gait_step.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::sim::rigid {
namespace {

constexpr int getUpFromFront = 15;
constexpr int getUpFromBack = 16;

void select(RigidRobot& robot, int code, int b, bool inMotion) {
  robot.action = code;
  robot.actionB = b;
  robot.inMotion = inMotion;
}

void kick(Tick& tick, std::size_t index, const Action& action) {
  const RigidRobot& robot = tick.state.robots[index];
  RigidBall& ball = tick.state.ball;
  const double dx = ball.position.x - robot.pose.position.x;
  const double dy = ball.position.y - robot.pose.position.y;
  const BallAtFeet before{repeatable::hypot(dx, dy),
                          wrapped(repeatable::atan2(dy, dx) - robot.pose.yaw)};
  const double hit =
      kickSpeed(tick.model(index), robotRadius(tick.world, index), action.code, before);
  if (hit <= 0.0) return;

  const NoiseParameters& noise = tick.noise(index);
  CounterRandom random(tick.settings().seed, tick.world.robots[index].id.value, NoiseStream::Kick,
                       tick.world.tick);
  const double speed = std::max(0.0, random.normal(hit, noise.kickSpeed));
  const double direction =
      random.normal(robot.pose.yaw + radiansFromDegrees(action.kick.direction), noise.kickAngle);
  const repeatable::SinCos unit = repeatable::sinCos(direction);
  ball.velocity = {speed * unit.cos, speed * unit.sin};
  ++tick.world.statistics[index].kicks;
  tick.report(EventKind::Kick, index, action.code);
}

/// The robot stands and swings its leg; control ignores commands until it is done.
void stepKick(Tick& tick, std::size_t index, ControlPercept& percept) {
  RigidRobot& robot = tick.state.robots[index];
  const RobotModel& model = tick.model(index);
  const double contact = std::min(model.kickContact, model.kickTime);
  const double before = robot.kickElapsed;
  robot.kickElapsed += tick.dt;
  const Action* action = findAction(robot.action);
  if (action && before <= contact && robot.kickElapsed > contact) kick(tick, index, *action);
  if (robot.kickElapsed < model.kickTime) return;
  percept.finishedAction = robot.action;
  robot.kickElapsed = -1.0;
  select(robot, 0, 0, false);
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
      if (tick.model(index).kickTime > 0.0) {
        select(robot, code, 0, false);
        robot.kickElapsed = 0.0;
        break;
      }
      kick(tick, index, *action);
      select(robot, 0, 0, false);
      percept.finishedAction = code;
      break;
  }
}

void beginGettingUp(RigidRobot& robot, const RobotModel& model) {
  const bool front = liesOnFront(robot);
  select(robot, front ? getUpFromFront : getUpFromBack, 0, false);
  robot.posture = Posture::GettingUp;
  robot.getUpRemaining = front ? model.getUpFront : model.getUpBack;
}

void stepDown(Tick& tick, std::size_t index, const RobotCommand& command, ControlPercept& percept) {
  RigidRobot& robot = tick.state.robots[index];
  if (robot.posture != Posture::GettingUp) {
    robot.getUpRemaining -= tick.dt;
    const int right = liesOnFront(robot) ? getUpFromFront : getUpFromBack;
    if (command.actionA == right || robot.getUpRemaining <= 0.0) {
      beginGettingUp(robot, tick.model(index));
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

bool motionIsNoisy(const NoiseParameters& noise) {
  return noise.forward != 0.0 || noise.sideways != 0.0 || noise.rotation != 0.0;
}

MotionNoise drawNoise(const Tick& tick, std::size_t index) {
  const NoiseParameters& noise = tick.noise(index);
  if (!tick.state.robots[index].inMotion || !motionIsNoisy(noise)) return {};
  RandomBatch::Sequence random = tick.batches.motion.of(index);
  // One statement each: the published order is rotation, forward, sideways.
  MotionNoise drawn;
  drawn.turn = random.normal(0.0, noise.rotation * tick.sqrtFrames);
  drawn.forward = random.normal(0.0, noise.forward * tick.sqrtFrames);
  drawn.sideways = random.normal(0.0, noise.sideways * tick.sqrtFrames);
  return drawn;
}

void setMotion(Tick& tick, std::size_t index) {
  const RobotModel& model = tick.model(index);
  RigidRobot& robot = tick.state.robots[index];
  Motion& motion = tick.motions[index];
  const GaitSpeed target =
      robot.inMotion ? gaitSpeed(model, robot.action, robot.actionB) : GaitSpeed{};
  const double gain = model.maxAcceleration * tick.dt;
  motion.forward = robot.forwardSpeed;
  motion.sideways = robot.sidewaysSpeed;
  robot.forwardSpeed = approach(robot.forwardSpeed, target.forward, gain);
  robot.sidewaysSpeed = approach(robot.sidewaysSpeed, target.left, gain);
  robot.yawRate = approach(robot.yawRate, target.turn, model.maxYawAcceleration * tick.dt);

  const MotionNoise noise = drawNoise(tick, index);
  motion.turned = robot.yawRate * tick.dt + noise.turn;
  robot.pose.yaw = wrapped(robot.pose.yaw + motion.turned);
  motion.heading.set(robot.pose.yaw);
  const double c = motion.heading.cos();
  const double s = motion.heading.sin();
  motion.velocity = {c * robot.forwardSpeed - s * robot.sidewaysSpeed,
                     s * robot.forwardSpeed + c * robot.sidewaysSpeed};
  motion.noise = {c * noise.forward - s * noise.sideways, s * noise.forward + c * noise.sideways};
  motion.push = motion.stopped = {};
}

}  // namespace

bool liesOnFront(const RigidRobot& robot) {
  return robot.posture == Posture::OnFront ||
         (robot.posture == Posture::GettingUp && robot.action == getUpFromFront);
}

void drawMotion(Tick& tick, std::span<const RandomBatch::Tick> ahead) {
  tick.draw(tick.batches.motion, motionIsNoisy, ahead);
}

void stepControl(Tick& tick, std::size_t index, const RobotCommand& command, Percepts& percept) {
  RigidRobot& robot = tick.state.robots[index];
  percept.control.action = command.actionA;
  if (isDown(robot)) {
    stepDown(tick, index, command, percept.control);
    // Localization must not believe that a robot on the ground walks.
    percept.control.action = robot.action;
  } else if (robot.kickElapsed >= 0.0) {
    stepKick(tick, index, percept.control);
  } else if (robot.action != command.actionA) {
    selectUpright(tick, index, command, percept.control);
  }
  const bool busy = robot.posture == Posture::GettingUp || robot.kickElapsed >= 0.0;
  percept.control.moving = robot.inMotion || busy ? 1 : 0;
  setMotion(tick, index);
}

void applyFall(Tick& tick, std::size_t index) {
  RigidRobot& robot = tick.state.robots[index];
  if (isDown(robot)) return;
  const Motion& motion = tick.motions[index];
  const Velocity& hit = motion.push;
  const double most = tick.model(index).fallImpulse;
  if (hit.x * hit.x + hit.y * hit.y <= most * most) return;
  const double along = hit.x * motion.heading.cos() + hit.y * motion.heading.sin();
  robot.posture = along > 0.0 ? Posture::OnFront : Posture::OnBack;
  robot.getUpRemaining = lyingTime;
  robot.kickElapsed = -1.0;
  select(robot, 0, 0, false);
  ++tick.world.statistics[index].falls;
  tick.report(EventKind::Fall, index);
}

}  // namespace pitchboard::sim::rigid
