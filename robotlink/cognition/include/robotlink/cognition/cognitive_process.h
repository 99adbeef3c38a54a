// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A process of the Cross Architecture as a class: the same object runs as its own OS process on a
// System V blackboard (pitchboard-robot) and in lock-step on a heap blackboard.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <base/ids.h>
#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/cognition/cognition_debug.h>
#include <robotlink/cognition/team_channel.h>
#include <simcore/world/field.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// Tells a process the time: seconds since its start, simulated or real.
struct Clock {
  double seconds = 0.0;
};

class ProcessTurns;

/// How an advisor thinks (docs/advisor.md).
struct AdvisorOptions {
  int rollouts = 72;     ///< for each decision
  double horizon = 5.0;  ///< s that each of them plays
  /// Of one core, when no match waits for it: it plays as many rollouts as fit. 0: `rollouts`.
  double share = 0.0;
  bool operator==(const AdvisorOptions&) const = default;
};

class CognitiveProcess {
 public:
  virtual ~CognitiveProcess() = default;
  /// One cycle. Never blocks. Errors of the outside (a socket) are counted, not thrown.
  virtual void step(Blackboard& board, const Clock& clock) = 0;
  /// Seconds between two steps.
  virtual double period() const = 0;
  /// What it has in mind, for a display: fills its own part (particles or path), leaves the rest.
  /// Called between steps, as seldom as the display likes; changes nothing.
  virtual void sendDebugData(CognitionDebug& cognitionDebug) const { (void)cognitionDebug; }

  // A match that is put back to an earlier moment starts its robots' processes anew, and then:
  /// Before the first step, of a robot that has been playing: begins with what stands on its
  /// blackboard instead of with nothing.
  virtual void resume(const Blackboard& board) { (void)board; }
  /// All that it remembers now, for recall(); null when it remembers nothing. Not to be stepped.
  virtual std::unique_ptr<const CognitiveProcess> remembered() const { return nullptr; }
  /// Goes on as the one would have that remembered this. False, and nothing has changed, when that
  /// was of another kind.
  virtual bool restore(const CognitiveProcess& memory) {
    (void)memory;
    return false;
  }
  /// Roughly what remembered() takes.
  virtual std::size_t memoryBytes() const { return 2048; }
};

/// What a process is told when it is made.
struct ProcessOptions {
  RobotId robot{1};
  std::string behaviour = "striker";     ///< decision only
  BehaviourParameters parameters;        ///< decision: the numbers of that behaviour
  std::string udpAddress = "127.0.0.1";  ///< where telemetry and team messages go
  int telemetryPortBase = 1240;          ///< telemetry goes to this + robot number
  double telemetryPeriod = 1.0;          ///< s between two telemetry datagrams
  int teamPortBase = 1230;               ///< team messages go to this + 1..4
  /// communication: our team's number in the GameController; absent = do not listen to one.
  std::optional<int> refereeTeam;
  /// communication: also writes the set play that the referee gives, for a decision of ours.
  bool tellSetPlay = false;
  std::optional<int> shirt;  ///< number in the GameController; absent = the robot's
  int refereePort = 3838;
  int channelPortBase = 10000;  ///< robots of a team hear each other on this + `team`

  sim::FieldSpec field;                ///< localization, decision: where lines and posts are
  sim::RobotModel model;               ///< localization, decision: how this robot walks and kicks
  std::uint64_t seed = 1;              ///< localization: of its particles
  int particles = 5000;                ///< localization: at most this many
  bool publishedLocalization = false;  ///< localization: the published filter's parameters
  /// Starts facing the left goal, so the IMU's zero is 180 degrees; absent = found out by itself.
  std::optional<bool> facesLeft;
  int team = 0;  ///< team: robots of one number hear each other, 0..99
  /// team: the in-process channel of lock-step runs; empty = UDP.
  std::shared_ptr<TeamChannel> teamChannel;
  AdvisorOptions advisor;
  /// Of a process whose time is that of a match; empty: the clock on the wall.
  std::shared_ptr<ProcessTurns> turns;

  /// Takes over the ports of a match.
  void setMatch(MatchNumber match);
};

}  // namespace pitchboard::link
