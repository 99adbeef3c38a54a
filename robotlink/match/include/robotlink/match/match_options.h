// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a match is to be played. Plain values.

#include <optional>
#include <string>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/processes/runtime_profile.h>

namespace pitchboard::link {

enum class Cognition {
  Separate,  ///< System V blackboards; the processes of every robot's runtime profile are started
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
  bool systemV = false;         ///< with Inline: System V blackboards, for watching
  std::optional<int> match;     ///< number of the match; nothing: the next free one
  std::optional<int> keyBase;   ///< key = this + 100 × robot number; nothing: the match's
  std::string robotProgram;     ///< pitchboard-robot; needed where processes run separately
  ProcessOptions process;       ///< for the processes; the ports are the match's
  bool cognitionDebug = false;  ///< hear particles and paths, for display
  RobotsPace pace = RobotsPace::LockStep;
  /// Times real time, with which it begins; 0 = as fast as possible. MatchRunner plays at it,
  /// others say it by setPlaying().
  double speed = 1.0;
  /// The match slows down to what a team's own programs manage.
  bool waitForTeamPrograms = true;
  /// Reference processes are told where their team attacks; else they find out.
  bool tellSides = true;
  /// Of robots of which neither the scenario nor their behaviour says who runs.
  RuntimeChoice runtime;
  /// With Inline: the referee of the match sends packets to process.refereePort of this computer,
  /// as it always does where processes run separately, or a team's own programs.
  bool sendReferee = false;
  /// Instead of its own referee, the match obeys a GameController that is heard on this port.
  std::optional<int> obeyReferee;
  /// Robots answer that GameController (RGrt), so that its screen shows them online: to this port
  /// of its computer, or 0 for the port of the packets' version. Nothing: they stay silent.
  std::optional<int> answerReferee{};
};

}  // namespace pitchboard::link
