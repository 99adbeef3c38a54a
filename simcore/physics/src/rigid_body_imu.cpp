// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_imu.h"

#include <numbers>

#include "rigid_body_control.h"

namespace pitchboard::sim::rigid {
namespace {

struct YawErrors {
  double drift = 0.0;
  double white = 0.0;
};

bool imuIsNoisy(const NoiseParameters& noise) {
  return noise.imuWhite != 0.0 || noise.imuDrift != 0.0;
}

YawErrors drawErrors(const Tick& tick, std::size_t index) {
  const NoiseParameters& noise = tick.noise(index);
  if (!imuIsNoisy(noise)) return {};
  RandomBatch::Sequence random = tick.batches.imu.of(index);
  YawErrors errors;
  errors.drift = random.normal(0.0, noise.imuDrift * tick.sqrtFrames);
  errors.white = random.normal(0.0, noise.imuWhite);
  return errors;
}

}  // namespace

void drawImu(Tick& tick, std::span<const RandomBatch::Tick> ahead) {
  tick.draw(tick.batches.imu, imuIsNoisy, ahead);
}

void stepImu(Tick& tick, std::size_t index, const RobotCommand& command, ImuPercept& percept) {
  RigidRobot& robot = tick.state.robots[index];
  const Motion& motion = tick.motions[index];
  const YawErrors errors = drawErrors(tick, index);
  robot.imuDrift += errors.drift;

  const double start = tick.world.robots[index].imuStartsAt180 ? std::numbers::pi : 0.0;
  const double yaw = wrapped(robot.pose.yaw - start) + robot.imuDrift;
  if (command.imuReset == 1) {
    robot.imuZero = yaw;
    percept.resetDone = true;
  }
  percept.eulerZ = wrapped(yaw - robot.imuZero + errors.white);

  const double yawRate = motion.turned / tick.dt;
  percept.gyro = {0.0, 0.0, yawRate};
  if (isDown(robot)) {
    const double sign = liesOnFront(robot) ? 1.0 : -1.0;
    percept.eulerXY = {0.0, sign * std::numbers::pi / 2.0};
    percept.accel = {sign, 0.0, 0.0};
    percept.state = 1;
    return;
  }
  // The gait's speeds live in the turning body's frame, hence the centripetal terms.
  const double ax = (robot.forwardSpeed - motion.forward) / tick.dt - yawRate * robot.sidewaysSpeed;
  const double ay =
      (robot.sidewaysSpeed - motion.sideways) / tick.dt + yawRate * robot.forwardSpeed;
  percept.eulerXY = {0.0, 0.0};
  percept.accel = {ax / gravity, ay / gravity, 1.0};
  percept.state = 0;
}

}  // namespace pitchboard::sim::rigid
