// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a scenario: owns the simulation, the robots with their blackboards and processes (inside
// this program in lock-step, separate OS processes, or none), and the bridge between them. It does
// not keep a pace; tick() advances one tick whenever it is called. Not thread-safe: MatchRunner
// owns it on its thread.

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
struct FollowedRecording;
struct FollowState;
struct ReceivedDrawing;
struct Moment;
struct RobotsMemory;

class SimulatedMatch {
 public:
  /// Starts a match. If it fails, no segment and no process is left behind. `catalog` must outlive
  /// the match.
  static Result<SimulatedMatch> create(
      const Scenario& scenario, const MatchOptions& options,
      const VariableCatalog& catalog = VariableCatalog::published());
  SimulatedMatch(SimulatedMatch&&) noexcept;
  SimulatedMatch& operator=(SimulatedMatch&&) noexcept;
  ~SimulatedMatch();  ///< ends the processes, removes the segments that it created

  /// Plays one tick: carries out scripted writes that are due, reads commands, steps the
  /// simulation, writes percepts, and runs the reference processes that are due, robot by robot. In
  /// lock-step it waits for separate processes, but not forever. Allocates nothing once all robots
  /// are there, except in behaviours that plan paths or talk to their team.
  void tick();
  /// Returns whether a stop condition of the scenario is met. The caller may continue to play.
  bool finished() const { return !finishedBy().empty(); }
  /// Returns "goal", "ball_out", "duration" or "full_time"; empty while none is met.
  std::string_view finishedBy() const;
  /// Returns true if a match without a referee is at least five seconds old and no robot has walked
  /// or been ordered to play (COM_REFEREE), which is usually a mistake in the scenario.
  bool nobodyPlays() const;

  /// Appends the events since the last call, at most the newest 1000: those of the simulation, the
  /// clock and the processes, and the end of the match.
  void drainEvents(std::vector<MatchEvent>& out);

  /// Appends the drawings since the last call. Only a match that shares blackboards with other
  /// programs receives drawings, on its drawing port (MatchNumber).
  void takeDrawings(std::vector<ReceivedDrawing>& out);
  /// Returns the receiver of drawings; null if this match has none.
  const MatchDrawings* drawings() const;

  const Scenario& scenario() const;
  sim::Simulation& simulation();
  const sim::Simulation& simulation() const;
  /// Gives access to the robots, to add, remove and change them.
  RobotSlots& robots();
  const RobotSlots& robots() const;
  /// Returns the robot's blackboard; null if there is no such robot.
  Blackboard* blackboard(RobotId id) const;
  /// Returns particles and paths of the robots, by number; empty without
  /// MatchOptions::cognitionDebug. Asks processes inside this program, and takes what separate ones
  /// have sent.
  std::vector<CognitionDebug> cognitionDebug();
  const RobotVariables& variables() const;
  const VariableCatalog& catalog() const;
  /// Returns the commands that the bridge read before the last tick, in the order of the
  /// simulation's robots; the default for a robot that was added since. With them and the state
  /// before, that tick can be repeated.
  std::span<const sim::RobotCommand> commands() const;
  /// Returns what the robots sensed in the last tick, in the same order.
  std::span<const sim::Percepts> percepts() const;
  /// Gives access to the pace that match and separate processes keep together.
  ProcessPace& pace() const;

  /// Restores a recorded moment exactly: adds and removes robots as needed, sets their behaviours,
  /// and writes the known blackboard words. If the moment has a past, reference processes inside
  /// this program get their memory back, and the match continues as it did then. Otherwise they
  /// restart with the belief on their blackboards, as separate ones do in their next cycle. An
  /// error leaves the match unchanged.
  Result<void> restore(const Moment& moment);

  /// Moves robots and ball as in a recording until one of the other robots changes what they would
  /// react to (followed_recording.h). From then on their processes command them. Null ends it, and
  /// so does restore().
  void follow(std::shared_ptr<const FollowedRecording> recording);
  const FollowState& followState() const;

  /// Returns whether playing the match again would give the same result. False once the match has
  /// not waited for a team program, or a program has not finished a cycle in time, and while
  /// processes run freely.
  bool isRepeatable() const;
  /// Returns the result so far.
  MatchResult result() const;

  /// Returns what the reference processes remember after this tick; null if none run inside this
  /// program.
  std::shared_ptr<const RobotsMemory> robotsMemory() const;

  /// Returns a scenario that starts from the present moment. Of past scripted writes, the last one
  /// of each variable is kept, at time 0. The memory of processes is not part of a scenario.
  Scenario toScenario() const;

 private:
  struct Parts;
  explicit SimulatedMatch(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::link
