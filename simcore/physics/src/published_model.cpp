// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <optional>

#include <base/angles.h>
#include <simcore/world/published_frame.h>

#include <simcore/physics/physics_model.h>
#include <simcore/world/published_geometry.h>
#include "published_math.h"
#include "published_motion.h"
#include "published_vision.h"

namespace pitchboard::sim {
namespace {

PublishedState& stateOf(WorldState& world) {
  return std::get<PublishedState>(world.physics);
}
const PublishedState& stateOf(const WorldState& world) {
  return std::get<PublishedState>(world.physics);
}

/// The published frame (published-exact.md), in the published order, always 1/60 s a tick.
class PublishedModel : public PhysicsModel {
 public:
  void reset(WorldState& world) const override {
    PublishedState state;
    const auto centre = published_frame::windowFromStudio(world.settings.field, Pose{});
    state.ball.x = centre.x;
    state.ball.y = centre.y;
    world.physics = state;
    stateOf(world).robots.reserve(highestRobotNumber);
  }

  bool owns(const WorldState& world) const override {
    const auto* state = std::get_if<PublishedState>(&world.physics);
    return state && state->robots.size() == world.robots.size();
  }

  BallSweep move(WorldState& world, std::span<const RobotCommand> commands,
                 std::span<Percepts> percepts, std::vector<Event>& events) override {
    const PublishedGeometry& geometry = geometryOf(world.settings.field);
    const std::size_t count = world.robots.size();
    for (std::size_t i = 0; i < count; ++i) {
      percepts[i] = Percepts{};
      published::moveRobot(world, geometry, i);
      published::controlRobot(world, geometry, i, commands[i], percepts[i], events);
      published::landmarkVision(world, geometry, i, commands[i], percepts[i]);
    }
    return published::moveBall(world, geometry);
  }

  void sense(WorldState& world, std::span<const RobotCommand> commands,
             std::span<Percepts> percepts) override {
    for (std::size_t i = 0; i < world.robots.size(); ++i)
      published::sight(world, i, commands[i], percepts[i]);
  }

  void robotAdded(WorldState& world, const Pose& pose) const override {
    stateOf(world).robots.emplace_back();
    placeRobot(world, stateOf(world).robots.size() - 1, pose);
  }

  void robotRemoved(WorldState& world, std::size_t index) const override {
    auto& robots = stateOf(world).robots;
    robots.erase(robots.begin() + static_cast<std::ptrdiff_t>(index));
  }

  void placeRobot(WorldState& world, std::size_t index, const Pose& pose) const override {
    const auto window = published_frame::windowFromStudio(world.settings.field, pose);
    PublishedRobot& robot = stateOf(world).robots[index];
    robot.view = published::mod360(robot.view + window.degrees - robot.rotate);
    robot.x = window.x;
    robot.y = window.y;
    robot.rotate = window.degrees;
  }

  void placeHead(WorldState& world, std::size_t index, double headYaw) const override {
    stateOf(world).robots[index].view = published::mod360(degreesFromRadians(headYaw));
  }

  void placeBall(WorldState& world, const Point& position,
                 const Velocity& velocity) const override {
    const auto window = published_frame::windowFromStudio(world.settings.field, {position, 0.0});
    PublishedBall& ball = stateOf(world).ball;
    ball.x = window.x;
    ball.y = window.y;
    ball.vx = published_frame::cmPerFrameFromMps(velocity.x);
    ball.vy = -published_frame::cmPerFrameFromMps(velocity.y);
  }

  double imuError(const WorldState& world, std::size_t index) const override {
    return radiansFromDegrees(stateOf(world).robots[index].orientationError);
  }

  void setImuError(WorldState& world, std::size_t index, double error) const override {
    stateOf(world).robots[index].orientationError = degreesFromRadians(error);
  }

  void settingsChanged(WorldState&) const override {}

  Pose robotPose(const WorldState& world, std::size_t index) const override {
    const PublishedRobot& robot = stateOf(world).robots[index];
    return published_frame::studioFromWindow(world.settings.field,
                                             {robot.x, robot.y, robot.rotate});
  }

  void describe(const WorldState& world, Snapshot& out) const override {
    const PublishedState& state = stateOf(world);
    const FieldSpec& field = world.settings.field;
    out.ball = published_frame::studioFromWindow(field, state.ball.x, state.ball.y);
    out.ballVelocity = {published_frame::mpsFromCmPerFrame(state.ball.vx),
                        -published_frame::mpsFromCmPerFrame(state.ball.vy)};
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
      const PublishedRobot& robot = state.robots[i];
      RobotSnapshot& shown = out.robots[i];
      shown.pose = robotPose(world, i);
      shown.headYaw = wrapToPi(radiansFromDegrees(robot.view));
      const double front = published_frame::mpsFromCmPerFrame(robot.front);
      const double left = published_frame::mpsFromCmPerFrame(robot.drift);
      const double cosine = std::cos(shown.pose.yaw);
      const double sine = std::sin(shown.pose.yaw);
      shown.velocity = {cosine * front - sine * left, sine * front + cosine * left};
      shown.action = robot.action;
      shown.fallen = shown.gettingUp = false;
    }
  }

 private:
  const PublishedGeometry& geometryOf(const FieldSpec& field) {
    if (!m_geometry || m_field != field) {
      m_field = field;
      m_geometry.emplace(field);
    }
    return *m_geometry;
  }

  FieldSpec m_field;
  std::optional<PublishedGeometry> m_geometry;  // derived from m_field; not part of the state
};

}  // namespace

std::unique_ptr<PhysicsModel> makePublishedModel() {
  return std::make_unique<PublishedModel>();
}

}  // namespace pitchboard::sim
