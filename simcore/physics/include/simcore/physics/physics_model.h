// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The strategy behind Simulation: one per motion and collision model. A model moves bodies and
// tells what robots sense; it knows no rules of the game. It keeps no state of its own that
// outlives a step: everything is in WorldState, whose `physics` alternative it owns. Used by one
// thread. A new model is a class here, a state in WorldState's variant and a line in
// physics_model.cpp.

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/snapshot.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

struct PhysicsModelInfo {
  std::string_view name;         ///< as in a scenario: "published", "rigid-body"
  std::string_view description;  ///< a sentence for people
};

/// Every motion and collision model, the default first.
std::span<const PhysicsModelInfo> physicsModels();

class PhysicsModel {
 public:
  virtual ~PhysicsModel() = default;

  /// Puts a fresh state of this model into `world`, ball on the centre mark, no robots.
  virtual void reset(WorldState& world) const = 0;
  virtual bool owns(const WorldState& world) const = 0;

  /// The first half of a tick: control and motion of all bodies. Fills what control says of itself,
  /// and whatever a model senses at that moment.
  virtual BallSweep move(WorldState& world, std::span<const RobotCommand> commands,
                         std::span<Percepts> percepts, std::vector<Event>& events) = 0;
  /// The second half, after the rules: what robots sense of the world as it is then.
  virtual void sense(WorldState& world, std::span<const RobotCommand> commands,
                     std::span<Percepts> percepts) = 0;

  /// Called after `world.robots` grew by one; the new robot stands still at `pose`.
  virtual void robotAdded(WorldState& world, const Pose& pose) const = 0;
  virtual void robotRemoved(WorldState& world, std::size_t index) const = 0;
  virtual void placeRobot(WorldState& world, std::size_t index, const Pose& pose) const = 0;
  virtual void placeHead(WorldState& world, std::size_t index, double headYaw) const = 0;
  virtual void placeBall(WorldState& world, const Point& position,
                         const Velocity& velocity) const = 0;
  /// By how much the yaw of the robot's IMU is off, rad: its drift, and where it was reset.
  virtual double imuError(const WorldState& world, std::size_t index) const = 0;
  virtual void setImuError(WorldState& world, std::size_t index, double error) const = 0;
  /// Called after settings (noise, constants) changed, to resize what depends on them.
  virtual void settingsChanged(WorldState& world) const = 0;

  virtual Pose robotPose(const WorldState& world, std::size_t index) const = 0;
  /// Fills everything of `out` that depends on the model; sizes are already right.
  virtual void describe(const WorldState& world, Snapshot& out) const = 0;
};

std::unique_ptr<PhysicsModel> makePublishedModel();
std::unique_ptr<PhysicsModel> makeRigidBodyModel();

/// Nothing when the name is unknown.
std::unique_ptr<PhysicsModel> makePhysicsModel(std::string_view name);

}  // namespace pitchboard::sim
