// SPDX-License-Identifier: GPL-3.0-or-later

// The `rigid-body` model: system.md section 4, last paragraph. This file holds the order of a tick
// and the edits by hand; the parts are in the rigid_body_*.cpp files beside it.

#include <algorithm>

#include <simcore/world/published_frame.h>

#include <simcore/physics/physics_model.h>
#include "rigid_body_collisions.h"
#include "rigid_body_control.h"
#include "rigid_body_imu.h"
#include "rigid_body_vision.h"

namespace pitchboard::sim {
namespace {

RigidBodyState& bodiesOf(WorldState& world) {
  return std::get<RigidBodyState>(world.physics);
}
const RigidBodyState& bodiesOf(const WorldState& world) {
  return std::get<RigidBodyState>(world.physics);
}

/// Memory that a tick needs and that says nothing afterwards: all matches of a thread have it in
/// common, so that many of them do not push each other out of the processor's caches.
struct Scratch {
  std::vector<rigid::Motion> motions;
  rigid::Noise batches;
  rigid::Collisions collisions;
};

Scratch& scratch() {
  static thread_local Scratch mine;
  return mine;
}

class RigidBodyModel final : public PhysicsModel {
 public:
  void reset(WorldState& world) const override {
    RigidBodyState state;
    state.robots.reserve(highestRobotNumber);
    world.physics = std::move(state);
  }

  bool owns(const WorldState& world) const override {
    const auto* state = std::get_if<RigidBodyState>(&world.physics);
    if (!state || state->robots.size() != world.robots.size()) return false;
    return state->past.size() == rigid::maxDelay(world) &&
           std::ranges::all_of(state->past, [&](const PastMoment& moment) {
             return moment.robots.size() == world.robots.size();
           });
  }

  BallSweep move(WorldState& world, std::span<const RobotCommand> commands,
                 std::span<Percepts> percepts, std::vector<Event>& events) override {
    Scratch& used = scratch();
    rigid::Tick tick = tickOf(world, events, used);
    const double dt = tick.dt;
    const std::size_t robots = tick.state.robots.size();
    used.motions.resize(robots);
    rigid::drawMotion(tick);
    for (std::size_t i = 0; i < robots; ++i) {
      percepts[i] = Percepts{};
      percepts[i].voltage = simulatedVoltage(world.models[i]);
      rigid::stepControl(tick, i, commands[i], percepts[i]);
    }
    used.collisions.advance(tick);
    for (std::size_t i = 0; i < robots; ++i) {
      const RigidRobot& robot = tick.state.robots[i];
      if (robot.inMotion) {
        world.statistics[i].distanceWalked +=
            dt * std::sqrt(robot.forwardSpeed * robot.forwardSpeed +
                           robot.sidewaysSpeed * robot.sidewaysSpeed);
      }
      if (world.settings.rigidBody.falls) rigid::applyFall(tick, i);
    }
    return tick.ball;
  }

  void sense(WorldState& world, std::span<const RobotCommand> commands,
             std::span<Percepts> percepts) override {
    std::vector<Event> none;  // senses report nothing
    rigid::Tick tick = tickOf(world, none, scratch());
    rigid::drawImu(tick);
    tick.batches.ballDrawn = tick.batches.ballAsLandmarkDrawn = false;
    for (std::size_t i = 0; i < tick.state.robots.size(); ++i) {
      rigid::stepImu(tick, i, commands[i], percepts[i].imu);
      rigid::stepVision(tick, i, commands[i], percepts[i]);
    }
    rigid::remember(tick);
  }

  void drawAhead(WorldState& world, std::span<const RandomBatch::Tick> ticks) override {
    if (ticks.empty()) return;
    std::vector<Event> none;
    rigid::Tick tick = tickOf(world, none, scratch());
    rigid::drawMotion(tick, ticks);
    rigid::drawImu(tick, ticks);
    rigid::drawSight(tick, ticks);
  }

  void robotAdded(WorldState& world, const Pose& pose) const override {
    RigidRobot robot;
    robot.pose = {pose.position, rigid::wrapped(pose.yaw)};
    bodiesOf(world).robots.push_back(robot);
  }

  void robotRemoved(WorldState& world, std::size_t index) const override {
    RigidBodyState& state = bodiesOf(world);
    const auto offset = static_cast<std::ptrdiff_t>(index);
    state.robots.erase(state.robots.begin() + offset);
    for (PastMoment& moment : state.past) moment.robots.erase(moment.robots.begin() + offset);
  }

  void placeRobot(WorldState& world, std::size_t index, const Pose& pose) const override {
    RigidRobot& robot = bodiesOf(world).robots[index];
    robot.pose = {pose.position, rigid::wrapped(pose.yaw)};
    // Taken up and put down: it stands, and starts its gait again.
    robot.forwardSpeed = robot.sidewaysSpeed = robot.yawRate = 0.0;
    robot.velocity = {};
  }

  void placeHead(WorldState& world, std::size_t index, double headYaw) const override {
    RigidRobot& robot = bodiesOf(world).robots[index];
    const double limit = world.models[index].panLimit;
    robot.headYaw = std::clamp(rigid::wrapped(headYaw - robot.pose.yaw), -limit, limit);
  }

  void placeBall(WorldState& world, const Point& position,
                 const Velocity& velocity) const override {
    bodiesOf(world).ball = {position, velocity};
  }

  double imuError(const WorldState& world, std::size_t index) const override {
    const RigidRobot& robot = bodiesOf(world).robots[index];
    return robot.imuDrift - robot.imuZero;
  }

  void setImuError(WorldState& world, std::size_t index, double error) const override {
    RigidRobot& robot = bodiesOf(world).robots[index];
    robot.imuDrift = error;
    robot.imuZero = 0.0;
  }

  void settingsChanged(WorldState& world) const override {
    rigid::resizePast(world, bodiesOf(world));
  }

  Pose robotPose(const WorldState& world, std::size_t index) const override {
    return bodiesOf(world).robots[index].pose;
  }

  void describe(const WorldState& world, Snapshot& out) const override {
    const RigidBodyState& state = bodiesOf(world);
    out.ball = state.ball.position;
    out.ballVelocity = state.ball.velocity;
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
      const RigidRobot& robot = state.robots[i];
      RobotSnapshot& described = out.robots[i];
      described.pose = robot.pose;
      described.headYaw = rigid::wrapped(robot.pose.yaw + robot.headYaw);
      described.velocity = robot.velocity;
      described.action = robot.action;
      described.fallen = rigid::isDown(robot);
      described.gettingUp = robot.posture == Posture::GettingUp;
    }
  }

 private:
  static rigid::Tick tickOf(WorldState& world, std::vector<Event>& events, Scratch& used) {
    const double frames = published_frame::framesPerSecond / world.settings.tickRate;
    return {world,
            bodiesOf(world),
            used.motions,
            events,
            used.batches,
            1.0 / world.settings.tickRate,
            std::sqrt(frames)};
  }
};

}  // namespace

std::unique_ptr<PhysicsModel> makeRigidBodyModel() {
  return std::make_unique<RigidBodyModel>();
}

}  // namespace pitchboard::sim
