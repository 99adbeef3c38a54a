// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scenario being played: the simulation, one blackboard per robot, the bridge between them, and
// the robots' processes (inline in lock-step, separate OS processes, or none). Not thread-safe: the
// runner owns it on its thread. No pacing here: tick() advances one tick whenever it is called.

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/processes/match_turns.h>
#include <robotlink/processes/process_manager.h>
#include <robotlink/processes/runtime_profile.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

enum class Cognition {
  External,  ///< System V blackboards; the processes of every robot's runtime profile are started
  Inline,    ///< heap blackboards, reference processes inside this program, in lock-step
  None       ///< System V blackboards, nothing started: every robot is somebody else's
};

/// How separate reference processes keep time with a match that is played at ×1. At every other
/// speed, and for a single step, they go in lock-step.
enum class RobotsPace {
  LockStep,  ///< the match waits for them in every tick: the same result every time
  Free       ///< as on the field, jitter included
};

struct MatchOptions {
  Cognition cognition = Cognition::Inline;
  bool systemV = false;        ///< with Inline: System V blackboards, for watching
  std::optional<int> match;    ///< number of the match; nothing: the next free one
  std::optional<int> keyBase;  ///< key = this + 100 × robot number; nothing: the match's
  std::string robotProgram;    ///< pitchboard-robot; needed where processes run separately
  ProcessOptions process;      ///< for the processes; the ports are the match's
  bool thoughts = false;       ///< hear particles and paths, for display
  RobotsPace pace = RobotsPace::LockStep;
  /// Times real time, with which it begins; 0 = as fast as possible. A team's programs that are
  /// started at 1 keep real time. MatchRunner plays at it, others say it by setPlaying().
  double speed = 1.0;
  /// Played at ×n, the match slows down to what a team's own programs manage.
  bool waitForOwnPrograms = false;
  /// Reference processes are told where their team attacks; else they find out.
  bool tellSides = true;
  /// Of robots of which neither the scenario nor their behaviour says who runs.
  RuntimeChoice runtime;
  /// With Inline: the referee of the match sends packets to process.refereePort of this computer,
  /// as it always does where processes run separately.
  bool sendReferee = false;
  /// Instead of its own referee, the match obeys a GameController that is heard on this port.
  std::optional<int> obeyReferee;
};

class MatchDrawings;
class MatchEvents;
class MatchReferee;
struct HeardDrawing;
struct Moment;
struct MomentPast;
struct RobotsMemory;
struct SeatProcess;

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
  /// the order of the robots each reference process whose period has passed; in lock-step it waits
  /// for separate ones, but not for ever. Allocates nothing once every robot is there, unless a
  /// behaviour that plans paths and talks to its team does.
  void tick();
  /// A stop condition of the scenario is met. Nothing keeps the caller from going on.
  bool finished() const { return !finishedBy().empty(); }
  /// "goal", "ball_out", "duration" or "full_time"; empty while none is met.
  std::string_view finishedBy() const;

  /// Appends what has happened since the last call, at most the newest 1000: in the simulation,
  /// to the clock, to processes (as the supervisor knows them), and the end of the match.
  void takeEvents(std::vector<MatchEvent>& out);

  /// Appends what programs have drawn since the last call. A match that shares blackboards with
  /// other programs hears it on its drawing port (MatchNumber).
  void takeDrawings(std::vector<HeardDrawing>& out);
  /// Null while nothing can be heard.
  const MatchDrawings* drawings() const { return m_drawings.get(); }

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
  /// What the last tick let the robots sense, in the same order.
  std::span<const sim::Percepts> percepts() const { return m_percepts; }
  /// The separate processes.
  ProcessManager& processes() { return *m_processes; }
  const ProcessManager& processes() const { return *m_processes; }
  /// Starts again what died, notices what is silent, takes what was written. About 20 times a
  /// second, also while the match stands still.
  void lookAfterProcesses(std::chrono::steady_clock::time_point now);
  /// How it is played from now on: times real time, 0 = as fast as possible; standing still.
  void setPlaying(double speed, bool still, std::chrono::steady_clock::time_point now);
  /// Slower than that for now, because a team's programs cannot keep up: their clocks follow.
  void slowTo(double speed, std::chrono::steady_clock::time_point now);
  /// At which pace to go on to `wanted` with a team's programs: see paceWithOwnPrograms(). Faster
  /// than real time only when the clocks of all of them can follow.
  double ownPace(double wanted, double now) const;
  /// A team's program that has just been started has not attached to its blackboard, so that a
  /// match without a pace is to wait; meanwhile the clocks of programs run at ×1. Ask again, and
  /// look after the processes, until it is false: the last one has attached, or ended, or was given
  /// up after its `silent_after`, at least 10 s (an event names it).
  bool awaitsPrograms(std::chrono::steady_clock::time_point now);
  /// This program, or one that it started, has attached to the blackboard of its robot.
  bool hasAttached(const ProcessStatus& program) const;
  /// Lets a team's own programs go on for this time while the match stands still.
  void letOwnProgramsRun(std::chrono::duration<double> time);
  void setPace(RobotsPace pace) { m_options.pace = pace; }
  RobotsPace pace() const { return m_options.pace; }
  void setWaitForOwnPrograms(bool on) { m_options.waitForOwnPrograms = on; }
  bool waitsForOwnPrograms() const { return m_options.waitForOwnPrograms; }
  /// Times real time: the slowest of a team's own programs that cannot keep up; nothing: all do.
  std::optional<double> slowestOwnProgram() const;
  /// Separate reference processes are waited for in every tick.
  bool inLockStep() const {
    return m_options.pace == RobotsPace::LockStep || m_still || m_speed != 1.0;
  }
  /// Its number on this computer; nothing while it shares no blackboard with others.
  std::optional<MatchNumber> number() const;
  /// Who plays match 0, when this one had to take another number; else empty.
  std::string publishedHolder() const;
  /// Robots whose processes nobody here has started, so that they do not stop with the match.
  std::vector<sim::RobotIdentity> robotsOfOthers() const;

  /// A robot with its blackboard and processes; scripted writes for every robot that are past are
  /// made up for. Errors leave the match as it was. Robots must be added and removed here, not at
  /// the simulation.
  Result<void> addRobot(const ScenarioRobot& robot);
  /// Ends its processes and removes its segment if this match created it.
  Result<void> removeRobot(RobotId id);
  /// Its decision starts anew with this behaviour (a name of behaviours(), or noBehaviour); the
  /// other processes go on, and those that only this behaviour needs come or go.
  Result<void> setBehaviour(RobotId id, const std::string& behaviour);
  /// Who runs from now on; all processes of the robot start anew.
  Result<void> setRuntime(RobotId id, const RuntimeChoice& choice);
  /// Starts a process of the robot anew, separate or not; NotFound when it has none of that name.
  Result<void> restartProcess(RobotId id, const std::string& process);
  RuntimeChoice runtime(RobotId id) const;
  /// Another team and shirt for the robot of this id; its processes start again. Conflict when the
  /// shirt is worn already.
  Result<void> setIdentity(const sim::RobotIdentity& identity);
  /// Which kind of robot it is; nothing when there is no such robot.
  const sim::RobotModel* robotModel(RobotId id) const;
  /// Another kind of robot from now on; its processes start again when they have to know.
  Result<void> setRobotModel(RobotId id, const sim::RobotModel& model);
  /// A call of the referee (a person's); see sim::Simulation::call().
  Result<void> call(const sim::RefereeCall& call) { return m_simulation.call(call); }
  /// The smallest robot number that is free (blackboard key, telemetry port).
  RobotId freeRobotId() const;

  /// Puts a recorded moment back exactly: robots come and go until they are those of the moment,
  /// with its behaviours, and what is known of their blackboards is written. Reference processes
  /// inside this program remember what they remembered then when the moment has a past, and the
  /// match goes on as it did; else they start anew with the belief on their blackboards, as
  /// separate ones do at their next turn. Errors leave the match as it was.
  Result<void> reenter(const Moment& moment);

  /// What the reference processes remember after this tick; null when none run inside.
  std::shared_ptr<const RobotsMemory> robotsMemory() const;

  /// The present moment as a scenario that starts from it. Scripted writes of the past are kept at
  /// time 0, each variable's last; what processes remember is not part of it.
  Scenario toScenario() const;

 private:
  struct Seat;   // one robot's blackboard, claim and inline processes
  struct Wish {  // who is to run for a robot
    RobotId id;
    std::string behaviour;
    RuntimeChoice choice;
  };
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
  void advance(bool again);
  void runProcesses();
  void startAnew();
  void playThrough(const MomentPast& past);
  void recall(const RobotsMemory& memory);
  std::uint64_t nextDueTick(double period, std::uint64_t after) const;
  Result<void> beginGame();
  void hearReferee(bool again = false);
  void followSides();
  Seat* seat(RobotId id) const;
  Result<RuntimeProfile> runtimeFor(const Wish& wish) const;
  bool sharesBoard(const Seat& seat, const RuntimeProfile& runtime) const;
  Result<void> identify();
  int keyOf(RobotId id) const;
  Result<void> checkShirt(const sim::RobotIdentity& identity) const;
  Result<std::unique_ptr<Seat>> makeSeat(const Wish& wish);
  const BlackboardBridge& bridgeOf(const Seat& seat) const;
  bool wants(const Seat& seat, const ProfileProcess& process) const;
  Result<void> startProcesses(Seat& seat);
  Result<void> restartProcesses(Seat& seat);
  Result<std::unique_ptr<SeatProcess>> startProcess(Seat& seat, const ProfileProcess& process);
  Result<void> startInside(Seat& seat, SeatProcess& process);
  Result<void> startReference(Seat& seat, SeatProcess& process);
  Result<void> startForeign(Seat& seat, SeatProcess& process);
  void endProcesses(Seat& seat);
  void runSeparate(Seat& seat, SeatProcess& process);
  void runFreely(Seat& seat, SeatProcess& process);
  bool isAwaited(const Seat& seat, SeatProcess& process, std::chrono::steady_clock::time_point now);
  bool dueNow(SeatProcess& process, std::optional<double> period);
  void giveTurn(Seat& seat, SeatProcess& process, bool lockStep);
  std::shared_ptr<TeamChannel> teamChannel(RobotId id);
  const sim::RobotIdentity& identityOf(RobotId id) const;
  ProcessOptions inlineOptions(const Seat& seat);
  std::vector<std::string> commandOf(const Seat& seat, const std::string& process) const;
  std::map<std::string, std::string> valuesFor(const Seat& seat) const;

  Scenario m_scenario;
  MatchOptions m_options;
  sim::Simulation m_simulation;
  const VariableCatalog* m_catalog;
  RobotVariables m_variables;
  BlackboardBridge m_bridge;
  BlackboardBridge m_extendedBridge;    // of robots whose decision knows the extension of the map
  std::vector<ResolvedWrite> m_writes;  // in order of tick
  std::vector<std::unique_ptr<Seat>> m_seats;  // same order as the simulation's robots
  std::vector<sim::RobotCommand> m_commands;
  std::vector<sim::Percepts> m_percepts;
  std::size_t m_nextWrite = 0;
  std::uint64_t m_expectedTick = 0;  // another one means that a moment was restored
  bool m_goalSeen = false, m_outSeen = false;
  std::array<std::shared_ptr<InProcessTeamChannel>, teamColors.size()> m_teamChannels;
  std::optional<ThoughtsReceiver> m_thoughts;
  std::unique_ptr<MatchEvents> m_events;
  std::unique_ptr<MatchReferee> m_referee;
  std::unique_ptr<MatchDrawings> m_drawings;
  std::shared_ptr<MatchClaim> m_claim;
  double m_speed = 0.0;
  bool m_still = false;
  std::chrono::steady_clock::time_point m_measured{};  // how fast "as fast as possible" is
  std::uint64_t m_measuredTick = 0;
  std::shared_ptr<MatchTurns> m_turns;
  std::unique_ptr<ProcessManager> m_processes;
};

}  // namespace pitchboard::link
