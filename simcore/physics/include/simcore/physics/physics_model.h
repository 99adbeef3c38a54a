// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The interface of physics models, which Simulation uses. A model moves bodies and computes what
// robots sense; it knows no rules of the game. Everything that outlives a step is in WorldState, of
// which the model owns one alternative of `physics`. Used by one thread at a time. To add a model,
// write a class, a state in WorldState's variant, and a line in physics_model.cpp.

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <base/random_batch.h>
#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/snapshot.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

struct PhysicsModelInfo {
  std::string_view name;         ///< its name in scenarios: "published", "rigid-body"
  std::string_view description;  ///< a sentence for people
};

/// Returns all physics models, the default first.
std::span<const PhysicsModelInfo> physicsModels();

class PhysicsModel {
 public:
  virtual ~PhysicsModel() = default;

  /// Initializes `world` for this model: the ball on the centre mark, no robots.
  virtual void reset(WorldState& world) const = 0;
  /// Returns whether world.physics contains the state of this model.
  virtual bool owns(const WorldState& world) const = 0;

  /// First half of a tick: control and motion of all bodies. Fills what control reports, and
  /// whatever the model senses at that point.
  virtual BallSweep move(WorldState& world, std::span<const RobotCommand> commands,
                         std::span<Percepts> percepts, std::vector<Event>& events) = 0;
  /// Second half of a tick, after the rules: fills what robots sense.
  virtual void sense(WorldState& world, std::span<const RobotCommand> commands,
                     std::span<Percepts> percepts) = 0;

  /// May draw the random numbers of these ticks together, which takes less time: ticks of worlds
  /// with the settings and robots of this one, which the caller plays next, in this order. Changes
  /// no result.
  virtual void drawAhead(WorldState& /*world*/, std::span<const RandomBatch::Tick> /*ticks*/) {}

  /// Called after `world.robots` grew by one; the new robot stands still at `pose`.
  virtual void robotAdded(WorldState& world, const Pose& pose) const = 0;
  virtual void robotRemoved(WorldState& world, std::size_t index) const = 0;
  virtual void placeRobot(WorldState& world, std::size_t index, const Pose& pose) const = 0;
  virtual void placeHead(WorldState& world, std::size_t index, double headYaw) const = 0;
  virtual void placeBall(WorldState& world, const Point& position,
                         const Velocity& velocity) const = 0;
  /// Returns the error of the yaw of a robot's IMU in rad: its drift, and the yaw at its last
  /// reset.
  virtual double imuError(const WorldState& world, std::size_t index) const = 0;
  virtual void setImuError(WorldState& world, std::size_t index, double error) const = 0;
  /// Called after noise or constants have changed, to resize what depends on them.
  virtual void settingsChanged(WorldState& world) const = 0;

  virtual Pose robotPose(const WorldState& world, std::size_t index) const = 0;
  /// Fills the parts of `out` that depend on the model. The sizes are already right.
  virtual void describe(const WorldState& world, Snapshot& out) const = 0;
};

std::unique_ptr<PhysicsModel> makePublishedModel();
std::unique_ptr<PhysicsModel> makeRigidBodyModel();

/// Returns the model of this name, or null.
std::unique_ptr<PhysicsModel> makePhysicsModel(std::string_view name);

}  // namespace pitchboard::sim
