// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A reference process as a class. The same object runs as a separate process on a System V
// blackboard (pitchboard-robot) or inside a match, in lock-step, on a blackboard on the heap. One
// thread at a time.

#include <cstddef>
#include <cstdint>
#include <functional>
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

namespace pitchboard::telemetry {
class DatagramBatch;
}

namespace pitchboard::link {

/// The time of a process: seconds since its start, simulated or real.
struct Clock {
  double seconds = 0.0;
};

class LockStepSlot;

/// Options of an advisor (docs/advisor.md).
struct AdvisorOptions {
  /// File with what it learned in earlier games; empty: none. A missing file is no error.
  std::string memory{};
  bool operator==(const AdvisorOptions&) const = default;
};

class CognitiveProcess {
 public:
  virtual ~CognitiveProcess() = default;
  /// Runs one cycle. Never blocks. Errors of sockets and the like are counted, not reported.
  virtual void step(Blackboard& board, const Clock& clock) = 0;
  /// Returns the seconds between two steps.
  virtual double period() const = 0;
  /// Writes its debug data (particles or path) to `cognitionDebug` and leaves the rest as it is.
  /// Called between steps, at the rate of the display; must not influence later steps.
  virtual void sendDebugData(CognitionDebug& cognitionDebug) const { (void)cognitionDebug; }

  // For matches that are restored to an earlier moment. They create the robots' processes again and
  // then call restore(), or resume() if the memory of the process was not saved.
  /// Initializes a new process of a robot that has already been playing from its blackboard. Called
  /// before the first step.
  virtual void resume(const Blackboard& board) { (void)board; }
  /// Called once, when the program or the match ends, before the process is destroyed.
  virtual void finish() {}
  /// Returns a copy of everything that the process remembers, for restore(); null if it remembers
  /// nothing. The copy is never stepped.
  virtual std::unique_ptr<const CognitiveProcess> remembered() const { return nullptr; }
  /// Continues from a copy that remembered() returned. Returns false, without a change, if the copy
  /// is of another kind of process.
  virtual bool restore(const CognitiveProcess& memory) {
    (void)memory;
    return false;
  }
  /// Returns the approximate size of such a copy.
  virtual std::size_t memoryBytes() const { return 2048; }
};

/// Options of reference processes. The process that uses an option is named first.
struct ProcessOptions {
  RobotId robot{1};
  std::string behaviour = "striker";     ///< decision
  BehaviourParameters parameters;        ///< decision: of that behaviour
  std::string udpAddress = "127.0.0.1";  ///< where telemetry and team messages are sent to
  int telemetryPortBase = 1240;          ///< telemetry is sent to this + robot number
  double telemetryPeriod = 1.0;          ///< s between two telemetry datagrams
  int teamPortBase = 1230;               ///< team messages are sent to this + 1..4
  /// communication: our team's number at the referee; empty: do not listen to a referee.
  std::optional<int> refereeTeam;
  /// communication: also write the current set play, which our decision process uses.
  bool announceSetPlay = false;
  std::optional<int> shirt;  ///< number in the GameController; empty: the robot's id
  int refereePort = 3838;
  /// communication: replaces the batch by the referee's datagrams since the last call; returns
  /// false if there are none. Empty: they come from refereePort.
  std::function<bool(telemetry::DatagramBatch&)> refereeDatagrams;
  bool sends = true;  ///< communication: false: it only does what others see on the blackboard
  int channelPortBase = 10000;  ///< team: robots of a team use the port this + `team`

  sim::FieldSpec field;                ///< localization, decision: where lines and posts are
  sim::RobotModel model;               ///< localization, decision: how this robot walks and kicks
  std::uint64_t seed = 1;              ///< localization: for its random numbers
  int particles = 5000;                ///< localization: at most this many
  bool publishedLocalization = false;  ///< localization: use the parameters of the published filter
  /// The robot starts facing the left goal, so its IMU reads 180 degrees there; empty: the process
  /// finds out by itself.
  std::optional<bool> facesLeft;
  int team = 0;  ///< team: 0..99; robots with the same number exchange messages
  /// team: the channel of robots inside this program; null: UDP.
  std::shared_ptr<TeamChannel> teamChannel;
  AdvisorOptions advisor;
  bool keepsMemory = true;  ///< advisor: it also writes AdvisorOptions::memory, not only reads it
  /// For a process that follows the time of a match; null: it follows real time.
  std::shared_ptr<LockStepSlot> lockStepSlot;

  /// Sets the ports of a match.
  void setMatch(MatchNumber match);
};

}  // namespace pitchboard::link
