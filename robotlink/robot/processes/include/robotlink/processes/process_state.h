// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The state of a robot's process. It has a header of its own, because code that shows a match needs
// nothing else from the process manager. Plain values; any thread.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/ids.h>

namespace pitchboard::link {

enum class ProcessState : std::uint8_t {
  Waiting,        ///< waits for its first start
  Running,        ///< runs and responds
  NotResponding,  ///< runs without a sign of life
  Restarting,     ///< has ended and will be started again
  Ended,          ///< has ended and will not be started again
  Stopped,        ///< stopped by hand
  GivenUp         ///< has ended too often
};

/// The time that the clocks of a team program show.
enum class ProcessClock : std::uint8_t {
  Match,          ///< match time, see setTime()
  Real,           ///< real time, because its profile says so
  RealNoLibrary,  ///< real time, because our library is not installed
  RealNotLoaded   ///< real time, because our library cannot be loaded into the program
};

/// Returns why the clocks of a program do not follow the match, as a clause; empty if they do.
const char* whyRealTime(ProcessClock clock);

/// Returns the file that a command runs, without its folder: the script of an interpreter.
std::string programOf(const std::vector<std::string>& command);

struct ProcessStatus {
  static constexpr std::size_t maxLastLines = 5;
  int id = 0;  ///< unique within a manager
  RobotId robot;
  std::string name;                  ///< "decision"
  std::vector<std::string> command;  ///< program and arguments, as it is started
  ProcessState state = ProcessState::Waiting;
  int pid = 0;                         ///< process number; 0 while it does not run
  int restarts = 0;                    ///< restarts so far
  std::string detail;                  ///< how it ended, or why it does not run
  std::vector<std::string> lastLines;  ///< last lines of output, the newest last
  /// How often it died, or ended although it is started again then; and how it did so last.
  int deaths = 0;
  std::string lastDeath;
  std::chrono::steady_clock::time_point started{};    ///< last start
  std::chrono::steady_clock::time_point nextStart{};  ///< valid in the state Restarting
  double cpu = 0.0;                                   ///< share of a core during the last second
  std::uint64_t memoryBytes = 0;
  std::optional<double> heartbeatAge{};     ///< s since the last sign of life; empty: not watched
  bool isTeamProgram = false;               ///< it is a team program
  ProcessClock clock = ProcessClock::Real;  ///< team programs only
  double speed = 0.0;  ///< times real time: the speed a team program has to keep; 0: not one
  /// The speed that a team program reaches, times real time. It is below `speed` if the program
  /// cannot keep up, and at most 1 if its clocks show real time. 0 while its normal rate is
  /// unknown.
  double achieved = 0.0;
  /// Cycles of a team program since its start: those it did, and those it did not do because it
  /// could not keep up.
  std::uint64_t cycles = 0, missedCycles = 0;
  /// Lines that it wrote and that drainLines() did not return, because they were too many.
  std::uint64_t linesLeftOut = 0;
  /// Returns whether it dies again and again, or has died and is not started again.
  bool keepsDying() const { return deaths > 1 || (deaths > 0 && state == ProcessState::Ended); }
  std::string program() const { return programOf(command); }
  bool operator==(const ProcessStatus&) const = default;
};

/// Returns true for a team program that reaches less than 95 % of the speed that it has to keep.
bool fallsBehind(const ProcessStatus& program);

}  // namespace pitchboard::link
