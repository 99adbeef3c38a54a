// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scenario being played: the simulation, its robots with their blackboards and processes (inline
// in lock-step, separate OS processes, or none), and the bridge between them. Not thread-safe: the
// runner owns it on its thread. No pacing here: tick() advances one tick whenever it is called.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/frame/match_result.h>
#include <robotlink/match/match_options.h>
#include <robotlink/match/process_pace.h>
#include <robotlink/match/robot_slots.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

class MatchDrawings;
struct ReceivedDrawing;
struct Moment;
struct RobotsMemory;

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
  /// The match has no game, is five seconds old, and no robot has walked or been told to play
  /// (COM_REFEREE): somebody forgot to.
  bool nobodyPlays() const;

  /// Appends what has happened since the last call, at most the newest 1000: in the simulation,
  /// to the clock, to processes (as the supervisor knows them), and the end of the match.
  void takeEvents(std::vector<MatchEvent>& out);

  /// Appends what programs have drawn since the last call. A match that shares blackboards with
  /// other programs hears it on its drawing port (MatchNumber).
  void takeDrawings(std::vector<ReceivedDrawing>& out);
  /// Null while nothing can be heard.
  const MatchDrawings* drawings() const;

  const Scenario& scenario() const;
  sim::Simulation& simulation();
  const sim::Simulation& simulation() const;
  /// Robots come, go and are changed there.
  RobotSlots& robots();
  const RobotSlots& robots() const;
  /// Nothing when there is no such robot.
  Blackboard* blackboard(RobotId id) const;
  /// Particles and paths of the robots, by number; none unless MatchOptions::cognitionDebug. Asks
  /// inline processes, or takes what separate ones have sent.
  std::vector<CognitionDebug> cognitionDebug();
  const RobotVariables& variables() const;
  const VariableCatalog& catalog() const;
  /// What the bridge read before the last tick, in the order of the simulation's robots (a robot
  /// that came since has the default). With it and the state before, that tick can be repeated.
  std::span<const sim::RobotCommand> commands() const;
  /// What the last tick let the robots sense, in the same order.
  std::span<const sim::Percepts> percepts() const;
  /// How it and the separate processes keep time with each other.
  ProcessPace& pace() const;

  /// Puts a recorded moment back exactly: robots come and go until they are those of the moment,
  /// with its behaviours, and what is known of their blackboards is written. Reference processes
  /// inside this program remember what they remembered then when the moment has a past, and the
  /// match goes on as it did; else they start anew with the belief on their blackboards, as
  /// separate ones do at their next turn. Errors leave the match as it was.
  Result<void> restore(const Moment& moment);

  /// The same match played again has the same result. False once a team's program has played that
  /// the match does not wait for, or that did not finish a cycle in time, or while processes run
  /// freely.
  bool isRepeatable() const;
  /// How it stands now; at the end, how it ended.
  MatchResult result() const;

  /// What the reference processes remember after this tick; null when none run inside.
  std::shared_ptr<const RobotsMemory> robotsMemory() const;

  /// The present moment as a scenario that starts from it. Scripted writes of the past are kept at
  /// time 0, each variable's last; what processes remember is not part of it.
  Scenario toScenario() const;

 private:
  struct Parts;
  explicit SimulatedMatch(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::link
