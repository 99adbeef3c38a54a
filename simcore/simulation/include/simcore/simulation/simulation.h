// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulated world. One object, one thread; no clock, no I/O: the caller says when a tick
// happens. step() advances exactly one tick and allocates nothing once all robots are there.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <simcore/physics/physics_model.h>
#include <simcore/rules/game_start.h>
#include <simcore/rules/referee.h>
#include <simcore/world/event.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/snapshot.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

/// What a state of the `published` physics asks for in vain, as sentences for people; none for
/// other models, and none when nothing is ignored.
std::vector<std::string> ignoredSettings(const SimulationSettings& settings,
                                         std::span<const RobotModel> models);

class Simulation {
 public:
  static constexpr int maxRobots = highestRobotNumber;

  /// An empty field with the ball on the centre mark. Fails on an unknown model, a field that
  /// cannot be played on, a tick rate outside 1..10000 Hz or noise that is not finite.
  static Result<Simulation> create(const SimulationSettings& settings);

  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// One tick. Both spans have one entry per robot in the order of state().robots; `percepts` is
  /// overwritten.
  void step(std::span<const RobotCommand> commands, std::span<Percepts> percepts);

  const WorldState& state() const { return m_state; }
  /// Puts a saved moment back; stepping on from it repeats what followed. Fails as create() does.
  Result<void> restore(const WorldState& state);
  std::uint64_t hash() const { return stateHash(m_state); }

  /// Fills `out`, reusing its memory.
  void snapshot(Snapshot& out) const;
  Snapshot snapshot() const;
  /// Events of the last step, in order.
  std::span<const Event> events() const { return m_events; }

  std::size_t robotCount() const { return m_state.robots.size(); }
  /// Index into state().robots, or nothing.
  std::optional<std::size_t> indexOf(RobotId id) const;
  std::optional<Pose> robotPose(RobotId id) const;

  // Edits by hand or by a script, between two steps. A pose outside the walls is moved inside.
  Result<void> addRobot(const RobotIdentity& identity, const Pose& pose,
                        const RobotModel& model = {});
  Result<void> removeRobot(RobotId id);
  Result<void> placeRobot(RobotId id, const Pose& pose);
  /// Turns the head to `headYaw` (rad, field frame); the published `view_rot`.
  Result<void> placeHead(RobotId id, double headYaw);
  Result<void> placeBall(const Point& position, const Velocity& velocity = {});
  Result<void> setNoise(const NoiseParameters& noise);
  void setClockRunning(bool running) { m_state.clockRunning = running; }
  void setScore(const Score& score) { m_state.score = score; }
  /// Another kind of robot from now on; changeable while running.
  Result<void> setRobotModel(RobotId id, const RobotModel& model);
  /// Constants of the rigid-body model; changeable while running.
  Result<void> setRigidBody(const RigidBodySettings& settings);
  /// Another model of motion and collisions (a name of physicsModels()) from now on; changeable
  /// while running. Places, headings, IMU errors and the ball's velocity are kept; robots stop, get
  /// up if they lay, and begin their action again at the next step. Error NotFound for an unknown
  /// name.
  Result<void> setPhysics(const std::string& name);

  /// A call of the referee, between two steps. Refused (Conflict) when the state of the game does
  /// not allow it, and when there is no referee. What it does is in events() of the next step.
  Result<void> call(const RefereeCall& call);
  /// Puts a referee's rules in, or takes the referee away; the game begins anew, and all robots of
  /// a team are told to attack the same goal. Error InvalidArgument for rules out of their range,
  /// and when more than two teams are on the field; nothing has changed then.
  Result<void> setReferee(const std::optional<RefereeRules>& rules);
  /// Begins the game of the referee anew, where `start` says. Error Conflict without a referee,
  /// else as sim::startGame(); nothing has changed then.
  Result<void> startGame(const GameStart& start);

  /// For conformance runs and scripts that speak the published frame: the state may be edited
  /// directly between steps. Sizes of per-robot vectors must not change.
  WorldState& editState() { return m_state; }

 private:
  Simulation();
  void carryOut();

  WorldState m_state;
  std::unique_ptr<PhysicsModel> m_model;
  std::vector<Event> m_events;
  std::vector<Event> m_called;  // by calls since the last step
  Placements m_placements;
  Snapshot m_seen;  // what the referee sees, after the bodies have moved
};

}  // namespace pitchboard::sim
