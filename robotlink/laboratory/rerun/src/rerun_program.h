// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A process that runs again on the blackboard of a rerun: one of ours, inside this program, or a
// separate program with clocks that follow the recording. Private to the module; the thread of the
// rerun, to which separate programs belong.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/processes/process_manager.h>
#include <robotlink/rerun/rerun.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// What is known of the robot that runs again.
struct RerunRobot {
  RobotId id;
  TeamColor team = TeamColor::Blue;
  int shirt = 1;
  std::string behaviour;  ///< as recorded; empty: unknown
  BehaviourParameters parameters;
  sim::FieldSpec field;
  sim::RobotModel model;
  std::uint64_t seed = 1;
  std::optional<bool> facesLeft;
  std::shared_ptr<TeamChannel> teamChannel{};  ///< team: where messages come from
  // communication: as in ProcessOptions.
  std::optional<int> refereeTeam{};
  std::function<bool(telemetry::DatagramBatch&)> refereeDatagrams{};
  bool announceSetPlay = false;
};

class RerunProgram {
 public:
  virtual ~RerunProgram() = default;
  /// Waits until it can run; called once, after all programs of the robot were started.
  virtual Result<void> awaitReady() { return {}; }
  /// Its turn in a tick. Fails if the program died or does not answer.
  virtual Result<void> cycle(std::uint64_t tick) = 0;
  /// A cycle of it, whether it is due or not, at this second of the recording.
  virtual Result<void> run(std::uint64_t tick, double seconds) = 0;
  /// The recorded process was started again: it remembers nothing.
  virtual Result<void> beginAnew(const RerunRobot&, std::uint64_t) { return {}; }
  /// Called when the robot has changed its direction of attack.
  virtual Result<void> changeSides(const RerunRobot& robot, std::uint64_t tick) = 0;
  /// Returns the largest speed (times real time; 0: unlimited) that it allows now.
  virtual double allowedSpeed(double wanted) = 0;
  /// Called between ticks, about 50 times a second, with the time played and the speed.
  virtual Result<void> lookAfter(double seconds, double speed) = 0;
  /// Returns whether the rerun waits for each of its cycles.
  virtual bool inLockStep() const = 0;
  /// Returns the process's turn in a tick (feed.h).
  virtual int turn() const = 0;
  /// Returns the name of the process.
  virtual const std::string& process() const = 0;
};

/// How a process is to run, from the text behind "decision=".
struct RerunChoice {
  std::string process;                 ///< "decision"
  bool isInside = false;               ///< one of ours
  BehaviourChoice behaviour;           ///< inside, decision: if chosen
  bool hasBehaviour = false;           ///< otherwise as recorded
  std::vector<std::string> command{},  ///< separate; may contain ${...}
      shown{};
  std::string directory{};
  std::vector<std::pair<std::string, std::string>> environment{};
  std::string cycle{};  ///< variable in which it reports its cycles
  double responseTimeout = 5.0;
  bool realClock = false;
};

/// RerunProcess::program of our own processes.
inline constexpr std::string_view referenceProgram = "reference";

/// Reads a choice. Fails with NotFound, with the names that are known.
Result<RerunChoice> rerunChoice(const RerunProcess& process, const RerunRobot& robot);

/// Makes a process of ours that starts after `tick`. With `resumes` it starts with what stands on
/// the blackboard, because it had been running before.
Result<std::unique_ptr<RerunProgram>> insideProgram(const RerunChoice& choice,
                                                    const RerunRobot& robot, Blackboard& board,
                                                    double tickRate, std::uint64_t tick,
                                                    bool resumes);

/// Where a separate program runs, and who is told of it.
struct ProgramPlace {
  Blackboard* board = nullptr;
  const VariableCatalog* catalog = nullptr;
  std::string robotProgram;  ///< empty: the one beside this program
  /// The rerun waits for this program's cycles if it cooperates. Of several programs of a robot
  /// only one does: they share the word.
  bool mayCooperate = true;
  std::function<bool()> goesOn;
  std::function<void(std::string)> print;
};

/// Starts a separate program.
Result<std::unique_ptr<RerunProgram>> separateProgram(const RerunChoice& choice,
                                                      const RerunRobot& robot,
                                                      const ProgramPlace& place);

}  // namespace pitchboard::link
