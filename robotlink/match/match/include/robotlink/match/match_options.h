// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a match is played: who decides, at which speed. Plain values; any thread.

#include <optional>
#include <string>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/processes/runtime_profile.h>

namespace pitchboard::link {

enum class Cognition {
  Separate,  ///< System V blackboards; the processes of every robot's runtime profile are started
  Inline,    ///< heap blackboards, reference processes inside this program, in lock-step
  None       ///< System V blackboards; nothing is started, the user starts all programs
};

/// How separate reference processes run at ×1. At every other speed, and for a single step, they
/// run in lock-step.
enum class RobotsPace {
  LockStep,  ///< the match waits for them in every tick: the same result every time
  Free       ///< as on the field, jitter included
};

struct MatchOptions {
  Cognition cognition = Cognition::Inline;
  bool systemV = false;      ///< with Inline: System V blackboards, for watching
  std::optional<int> match;  ///< number of the match; nothing: the next free number
  /// The next free number is one that has no blackboards yet. Otherwise programs that were started
  /// before the match keep theirs, with what stands on them.
  bool newBoards = false;
  std::optional<int> keyBase;   ///< key = this + 100 × robot number; nothing: from the match
  std::string robotProgram;     ///< path of pitchboard-robot; needed for separate processes
  ProcessOptions process;       ///< for the processes; the ports are the match's
  bool cognitionDebug = false;  ///< receive particles and paths, for display
  RobotsPace pace = RobotsPace::LockStep;
  /// Initial speed, times real time; 0: as fast as possible. MatchRunner uses it; others call
  /// setPlaying().
  double speed = 1.0;
  /// Slow the match down to what team programs manage.
  bool waitForTeamPrograms = true;
  /// Tell reference processes where their team attacks; otherwise they find out.
  bool announceSides = true;
  /// The runtime of robots for which neither scenario nor behaviour names one.
  RuntimeChoice runtime;
  /// With Inline: let the referee send packets to process.refereePort of this computer, as it
  /// always does if there are separate processes or team programs.
  bool sendReferee = false;
  /// Obey a GameController that sends to this port, instead of the match's own referee.
  std::optional<int> obeyReferee;
  /// Let robots answer that GameController (RGrt), so that it shows them online: on this port of
  /// its computer, or 0 for the port of the packets' version. Nothing: they do not answer.
  std::optional<int> answerReferee{};
};

}  // namespace pitchboard::link
