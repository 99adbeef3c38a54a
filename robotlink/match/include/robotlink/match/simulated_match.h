// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scenario being played: the simulation, one blackboard per robot, the bridge between them, and
// the robots' processes (inline in lock-step, separate OS processes, or none). Not thread-safe: the
// runner owns it on its thread. No pacing here: tick() advances one tick whenever it is called.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/processes/process_supervisor.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

enum class Cognition {
  External,  ///< System V blackboards; reference processes are started for every robot
  Inline,    ///< heap blackboards, deterministic processes in lock-step
  None       ///< System V blackboards, nothing started: for a team's own processes
};

struct MatchOptions {
  Cognition cognition = Cognition::Inline;
  bool systemV = false;      ///< with Inline: System V blackboards, for watching
  int keyBase = 0;           ///< key = keyBase + 100 × robot number
  std::string robotProgram;  ///< pitchboard-robot; needed for External
  ProcessOptions process;    ///< addresses and ports for the processes
  bool thoughts = false;     ///< hear particles and paths, for display
  /// The referee of the match sends packets to process.refereePort of this computer. Without it
  /// only inline robots hear it.
  bool sendReferee = false;
  /// Instead of its own referee, the match obeys a GameController that is heard on this port.
  std::optional<int> obeyReferee;
};

class MatchEvents;
class MatchReferee;
struct Moment;

class SimulatedMatch {
 public:
  /// Fails with the reason, and leaves no segment and no process behind. `catalog` must outlive the
  /// match.
  static Result<SimulatedMatch> create(
      const Scenario& scenario, const MatchOptions& options,
      const VariableCatalog& catalog = VariableCatalog::published());
  SimulatedMatch(SimulatedMatch&&) noexcept;
  SimulatedMatch& operator=(SimulatedMatch&&) noexcept;
  ~SimulatedMatch();  ///< ends the processes, removes the segments that it created

  /// Scripted writes that are due (time <= now), commands, one simulation step, percepts, then in
  /// the order of the robots each inline process whose period has passed. Allocates nothing once
  /// every robot is there, unless a behaviour that plans paths and talks to its team does.
  void tick();
  /// A stop condition of the scenario is met. Nothing keeps the caller from going on.
  bool finished() const { return !finishedBy().empty(); }
  /// "goal", "ball_out", "duration" or "full_time"; empty while none is met.
  std::string_view finishedBy() const;

  /// Appends what has happened since the last call, at most the newest 1000: in the simulation,
  /// to the clock, to processes (as the supervisor knows them), and the end of the match.
  void takeEvents(std::vector<MatchEvent>& out);

  const Scenario& scenario() const { return m_scenario; }
  sim::Simulation& simulation() { return m_simulation; }
  const sim::Simulation& simulation() const { return m_simulation; }
  /// Nothing when there is no such robot.
  Blackboard* blackboard(RobotId id);
  const Blackboard* blackboard(RobotId id) const;
  /// Empty when there is no such robot.
  std::string_view behaviour(RobotId id) const;
  /// Particles and paths of the robots, by number; none unless MatchOptions::thoughts. Asks inline
  /// processes, or takes what separate ones have sent.
  std::vector<RobotThoughts> thoughts();
  const RobotVariables& variables() const { return m_variables; }
  const VariableCatalog& catalog() const { return *m_catalog; }
  /// What the bridge read before the last tick, in the order of the simulation's robots (a robot
  /// that came since has the default). With it and the state before, that tick can be repeated.
  std::span<const sim::RobotCommand> commands() const { return m_commands; }
  ProcessSupervisor& supervisor() { return *m_supervisor; }
  const ProcessSupervisor& supervisor() const { return *m_supervisor; }

  /// A robot with its blackboard and processes; scripted writes for every robot that are past are
  /// made up for. Errors leave the match as it was. Robots must be added and removed here, not at
  /// the simulation.
  Result<void> addRobot(const ScenarioRobot& robot);
  /// Ends its processes and removes its segment if this match created it.
  Result<void> removeRobot(RobotId id);
  /// Restarts the robot's processes, its decision with this behaviour (a name of behaviours(), or
  /// noBehaviour). The robot itself and its blackboard stay as they are.
  Result<void> setBehaviour(RobotId id, const std::string& behaviour);
  /// Another team and shirt for the robot of this id; its processes start again. Conflict when the
  /// shirt is worn already.
  Result<void> setIdentity(const sim::RobotIdentity& identity);
  /// A call of the referee (a person's); see sim::Simulation::call().
  Result<void> call(const sim::RefereeCall& call) { return m_simulation.call(call); }
  /// The smallest robot number that is free (blackboard key, telemetry port).
  RobotId freeRobotId() const;

  /// Puts a recorded moment back exactly: robots come and go until they are those of the moment,
  /// and what is known of their blackboards is written. Stepping on repeats what followed as long
  /// as the robots are told the same; what their processes remember is not part of a moment. Errors
  /// leave the match as it was.
  Result<void> reenter(const Moment& moment);

  /// The present moment as a scenario that starts from it. Scripted writes of the past are kept at
  /// time 0, each variable's last; what processes remember is not part of it.
  Scenario toScenario() const;

 private:
  struct Seat;  // one robot's blackboard, claim and inline processes
  struct ResolvedWrite {
    std::uint64_t tick = 0;
    RobotId robot;
    std::variant<IntVar, FloatVar> variable;
    double value = 0.0;
  };

  SimulatedMatch(const Scenario& scenario, const MatchOptions& options, sim::Simulation simulation,
                 const VariableCatalog& catalog);
  Result<void> resolveWrites();
  void apply(const ResolvedWrite& write);
  void applyDueWrites();
  void followJump();
  void runInlineProcesses();
  Result<void> beginGame();
  void hearReferee();
  void followSides();
  std::uint64_t nextDueTick(double period) const;
  Seat* seat(RobotId id) const;
  bool sharesBoards() const;
  Result<void> checkShirt(const sim::RobotIdentity& identity) const;
  Result<std::unique_ptr<Seat>> makeSeat(const ScenarioRobot& robot) const;
  Result<void> startProcesses(Seat& seat);
  Result<void> restartProcesses(Seat& seat);
  Result<void> startProcess(Seat& seat, const ProcessInfo& info);
  ProcessOptions inlineOptions(const Seat& seat);
  std::vector<std::string> commandOf(const Seat& seat, const ProcessInfo& info) const;

  Scenario m_scenario;
  MatchOptions m_options;
  sim::Simulation m_simulation;
  const VariableCatalog* m_catalog;
  RobotVariables m_variables;
  BlackboardBridge m_bridge;
  std::vector<ResolvedWrite> m_writes;         // in order of tick
  std::vector<std::unique_ptr<Seat>> m_seats;  // same order as the simulation's robots
  std::vector<sim::RobotCommand> m_commands;
  std::vector<sim::Percepts> m_percepts;
  std::size_t m_nextWrite = 0;
  std::uint64_t m_expectedTick = 0;  // another one means that a moment was restored
  bool m_goalSeen = false, m_outSeen = false;
  std::array<std::shared_ptr<TeamChannel>, teamColors.size()> m_teamChannels;
  std::optional<ThoughtsReceiver> m_thoughts;
  std::unique_ptr<MatchEvents> m_events;
  std::unique_ptr<MatchReferee> m_referee;
  std::unique_ptr<ProcessSupervisor> m_supervisor;
};

}  // namespace pitchboard::link
