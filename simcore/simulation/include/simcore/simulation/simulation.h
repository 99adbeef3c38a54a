// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulated world. It has no clock and no input or output: the caller decides when a tick
// happens, and step() advances the world by exactly one tick, without allocating memory once all
// robots are there. One thread at a time. Metres, radians and seconds, unless a name says
// otherwise.

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

/// Returns sentences about settings that the `published` physics ignores; none for other models.
std::vector<std::string> ignoredSettings(const SimulationSettings& settings,
                                         std::span<const RobotModel> models);

class Simulation {
 public:
  static constexpr int maxRobots = highestRobotNumber;

  /// Creates an empty field with the ball on the centre mark. Fails for an unknown model, a field
  /// that cannot be played on, a tick rate outside 1 to 10000 Hz, or noise that is not finite.
  static Result<Simulation> create(const SimulationSettings& settings);

  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Advances the world by one tick. Both spans have one entry per robot, in the order of
  /// state().robots; `percepts` is overwritten.
  void step(std::span<const RobotCommand> commands, std::span<Percepts> percepts);

  const WorldState& state() const { return m_state; }
  /// Restores a saved state. Steps from there repeat what followed. Fails as create() does.
  Result<void> restore(const WorldState& state);
  /// Swaps the world's course with another one of the same settings and robots, without a referee:
  /// continues another world, whose events begin with the next step.
  void exchange(WorldCourse& course);
  /// Prepares the next steps, ticks of worlds that exchange() will bring in this order: drawing
  /// their random numbers together takes less time.
  void drawAhead(std::span<const RandomBatch::Tick> ticks) { m_model->drawAhead(m_state, ticks); }
  std::uint64_t hash() const { return stateHash(m_state); }

  /// Fills `out` with what people see of the world, reusing its memory.
  void snapshot(Snapshot& out) const;
  Snapshot snapshot() const;
  /// Returns the events of the last step, in order.
  std::span<const Event> events() const { return m_events; }
  /// Returns those of them that drainCalled() has not returned before.
  std::span<const Event> untakenEvents() const {
    return std::span(m_events).subspan(m_eventsTaken);
  }
  /// Returns the events of calls by hand since the last step, each once, so that they can be
  /// reported while nothing is played. The next step puts all of them in front of its own events.
  std::span<const Event> drainCalled();

  std::size_t robotCount() const { return m_state.robots.size(); }
  /// Returns the index of a robot in state().robots, or nothing.
  std::optional<std::size_t> indexOf(RobotId id) const;
  std::optional<Pose> robotPose(RobotId id) const;

  // Edits between two steps, by hand or by a script. A pose outside the walls is moved inside.
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
  /// Changes the model of a robot, at any time between two steps.
  Result<void> setRobotModel(RobotId id, const RobotModel& model);
  /// Changes the constants of the rigid-body model.
  Result<void> setRigidBody(const RigidBodySettings& settings);
  /// Changes the physics model (a name of physicsModels()). Positions, yaw, IMU errors and the
  /// ball's velocity are kept. Robots stop, stand up if they had fallen, and start their action
  /// again at the next step. Fails with NotFound for an unknown name.
  Result<void> setPhysics(const std::string& name);

  /// Carries out a call of the referee. Fails with Conflict if the state of the game does not allow
  /// it, or if there is no referee. Its effects are in events() of the next step.
  Result<void> call(const RefereeCall& call);
  /// Adds an event to the next step that says that a user changed this setting.
  void reportChanged(Setting setting, std::uint32_t cause);
  /// Adds an event to the next step that says that everything with this cause was undone.
  void reportUndone(std::uint32_t cause);
  /// Adds events to the next step that say what a GameController's packet has changed in the game
  /// since `before`, as sim::reportObeyed() does.
  void reportObeyed(const Game& before, bool joins);
  /// Sets the referee's rules, or removes the referee. The game starts over, and all robots of a
  /// team attack the same goal. Fails with InvalidArgument for rules out of range or more than two
  /// teams, and then nothing has changed.
  Result<void> setReferee(const std::optional<RefereeRules>& rules);
  /// Starts the referee's game over, at the point that `start` describes. Fails with Conflict
  /// without a referee, or as sim::startGame() does; then nothing has changed.
  Result<void> startGame(const GameStart& start);

  /// Gives direct access to the state between steps, for conformance runs and scripts in the
  /// published frame. Do not change the sizes of per-robot vectors.
  WorldState& editState() { return m_state; }

 private:
  Simulation();
  void carryOut();
  /// So that steps with these robots allocate nothing.
  void makeRoom();

  WorldState m_state;
  std::unique_ptr<PhysicsModel> m_model;
  std::vector<Event> m_events;
  std::vector<Event> m_called;                       // made by calls since the last step
  std::size_t m_eventsTaken = 0, m_calledTaken = 0;  // how many of each drainCalled() has returned
  Placements m_placements;
  Snapshot m_seen;  // what the referee sees, after the bodies have moved
};

}  // namespace pitchboard::sim
