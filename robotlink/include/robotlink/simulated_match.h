// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scenario being played: the simulation, one blackboard per robot, the bridge between them, and
// the robots' processes (inline in lock-step, separate OS processes, or none). Not thread-safe: the
// runner owns it on its thread. No pacing here: tick() advances one tick whenever it is called.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <robotlink/blackboard.h>
#include <robotlink/blackboard_bridge.h>
#include <robotlink/cognitive_process.h>
#include <robotlink/process_supervisor.h>
#include <robotlink/scenario.h>
#include <robotlink/system_v.h>
#include <simcore/simulation.h>

namespace pitchboard::link {

enum class Cognition {
  External,  ///< System V blackboards; reference processes are started for every robot
  Inline,    ///< heap blackboards, deterministic processes in lock-step
  None       ///< System V blackboards, nothing started: for a team's own processes
};

struct MatchOptions {
  Cognition cognition = Cognition::Inline;
  bool systemV = false;              ///< with Inline: share the blackboards too, for watching
  int keyBase = 0;                   ///< key = keyBase + 100 × robot number
  std::string robotProgram;          ///< pitchboard-robot; needed for External
  ProcessOptions process;            ///< addresses and ports for the processes
};

class SimulatedMatch {
 public:
  static Result<SimulatedMatch> create(const Scenario& scenario, const MatchOptions& options,
                                       const VariableCatalog& catalog = VariableCatalog::published());
  SimulatedMatch(SimulatedMatch&&) noexcept;
  SimulatedMatch& operator=(SimulatedMatch&&) noexcept;
  ~SimulatedMatch();  ///< ends the processes, removes the segments that it created

  /// Scripted writes, commands, one simulation step, percepts, inline processes.
  void tick();
  /// A stop condition of the scenario is met.
  bool finished() const;

  const Scenario& scenario() const { return m_scenario; }
  sim::Simulation& simulation() { return m_simulation; }
  const sim::Simulation& simulation() const { return m_simulation; }
  Blackboard* blackboard(RobotId id);
  const RobotVariables& variables() const { return m_variables; }
  ProcessSupervisor& supervisor() { return *m_supervisor; }

  /// A robot with its blackboard and processes. Errors leave the match as it was.
  Result<void> addRobot(const ScenarioRobot& robot);
  Result<void> removeRobot(RobotId id);
  /// Restarts the robot's processes, its decision with this behaviour (a name of behaviours(), or
  /// noBehaviour). The robot itself and its blackboard stay as they are.
  Result<void> setBehaviour(RobotId id, const std::string& behaviour);
  /// The smallest robot number that is free (blackboard key, telemetry port).
  RobotId freeRobotId() const;

  /// The present moment as a scenario.
  Scenario toScenario() const;

 private:
  struct Seat;  // one robot's blackboard, claim and inline processes
  SimulatedMatch(const Scenario& scenario, const MatchOptions& options, sim::Simulation simulation,
                 const VariableCatalog& catalog);

  Scenario m_scenario;
  MatchOptions m_options;
  sim::Simulation m_simulation;
  const VariableCatalog* m_catalog;
  RobotVariables m_variables;
  BlackboardBridge m_bridge;
  std::vector<std::unique_ptr<Seat>> m_seats;   // same order as the simulation's robots
  std::vector<sim::RobotCommand> m_commands;
  std::vector<sim::Percepts> m_percepts;
  std::size_t m_nextWrite = 0;
  bool m_goalSeen = false, m_outSeen = false;
  std::unique_ptr<ProcessSupervisor> m_supervisor;
};

}  // namespace pitchboard::link
