// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The strategy behind Simulation: one per motion and collision model. A model keeps no state of its
// own that outlives a step: everything is in WorldState, whose `physics` alternative it owns.
// A new model is a class here, a state in WorldState's variant and a line in physics_model.cpp.

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <simcore/physics/simulation.h>

namespace pitchboard::sim {

class PhysicsModel {
 public:
  virtual ~PhysicsModel() = default;

  /// Puts a fresh state of this model into `world`, ball on the centre mark, no robots.
  virtual void reset(WorldState& world) const = 0;
  virtual bool owns(const WorldState& world) const = 0;

  virtual void step(WorldState& world, std::span<const RobotCommand> commands,
                    std::span<Percepts> percepts, std::vector<Event>& events) = 0;

  /// Called after `world.robots` grew by one; the new robot stands still at `pose`.
  virtual void robotAdded(WorldState& world, const Pose& pose) const = 0;
  virtual void robotRemoved(WorldState& world, std::size_t index) const = 0;
  virtual void placeRobot(WorldState& world, std::size_t index, const Pose& pose) const = 0;
  virtual void placeHead(WorldState& world, std::size_t index, double headYaw) const = 0;
  virtual void placeBall(WorldState& world, const Point& position,
                         const Velocity& velocity) const = 0;
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
