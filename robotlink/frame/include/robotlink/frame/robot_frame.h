// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All that is known of one robot at one moment, whatever its source: how it stands, what it
// believes and sees, how it is heard, what it has in mind, which of its processes run. Plain values
// in metres, radians and seconds; what nobody knows is empty.

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/robot_key.h>
#include <robotlink/cognition/cognition_debug.h>
#include <robotlink/frame/live_values.h>
#include <robotlink/processes/process_state.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::link {

/// One of the processes that were started for a robot.
struct ProcessSummary {
  int id = 0;        ///< for orders to it
  std::string name;  ///< "decision"
  ProcessState state = ProcessState::Waiting;
  int pid = 0;  ///< 0 while it does not run
  int restarts = 0;
  std::string detail;                               ///< how it ended, why it does not run
  std::vector<std::string> lastLines;               ///< the newest last
  std::chrono::steady_clock::time_point started{};  ///< the last time
  double cpu = 0.0;                                 ///< share of a core, of the last second
  std::uint64_t memoryBytes = 0;
  std::optional<double> heartbeatAge{};  ///< s since a sign of life; nothing: nobody watches
  bool foreign = false;                  ///< a program of the team
  double speed = 0.0;                    ///< times real time, that it is to keep; 0: ours
  double achieved = 0.0;                 ///< what it manages of that; 0: not known yet
  std::string whyRealTime;               ///< why its clocks do not follow the match; empty: they do
  std::uint64_t missedCycles = 0;        ///< of a team's program that could not keep up
  bool operator==(const ProcessSummary&) const = default;
};

/// A ball as a robot sees it.
struct SeenBall {
  Point place;            ///< on the field, from where it believes to stand
  double distance = 0.0;  ///< m
  double bearing = 0.0;   ///< rad, left of its nose
  bool operator==(const SeenBall&) const = default;
};

/// What stands on a received blackboard.
struct BoardContents {
  std::shared_ptr<const std::vector<std::string>> names;  ///< null: none is received
  std::vector<double> values;  ///< of each name; exact for every int32 and float32
};

/// What is known of a robot besides where it truly is (buildRobot()).
struct RobotView {
  /// Where it believes to stand. Of a robot whose true pose is known: while its localization works.
  std::optional<Pose> belief;
  std::optional<double> sigma;                ///< m, of the belief
  std::optional<SeenBall> ball;               ///< nothing while it is not heard any more
  std::optional<int> decided;                 ///< DECISION_ACTION_A
  std::optional<telemetry::Battery> battery;  ///< nothing: it tells no voltage
  /// Communication (of a simulated robot) or control, vision, localization, decision, IMU.
  std::array<telemetry::ProcessHeartbeat, telemetry::processCount> lamps{};
  std::optional<telemetry::LinkHealth> link;  ///< of one that is heard, or whose blackboard is read
  std::optional<Penalty> penalty;             ///< as its referee says
  std::vector<ReceivedValue> values;          ///< of its message: all, in their order
  std::optional<int> boardKey;                ///< of its blackboard: System V key, 0: heap
  BoardContents board;                        ///< of one that is attached, or sent by its robot
  std::string behaviour;
  std::string ownName;    ///< what its team calls it (team setups)
  std::string runtime;    ///< who runs, as it was chosen for it; empty: nothing was
  bool ofOthers = false;  ///< its processes were started by somebody else, if by anybody
  std::optional<CognitionDebug>
      cognitionDebug;  ///< of one that tells it (MatchOptions::cognitionDebug)
  /// Shared by many frames: processes seldom change. Read with processes().
  std::shared_ptr<const std::vector<ProcessSummary>> processList;

  /// Those that were started for it, in order.
  std::span<const ProcessSummary> processes() const {
    return processList ? std::span<const ProcessSummary>(*processList)
                       : std::span<const ProcessSummary>{};
  }
  /// It is heard, but not lately.
  bool timedOut() const { return link && link->timedOut; }
  /// False for one that is heard and never said where it is.
  bool poseKnown() const { return !link || belief; }
};

/// A robot's snapshot, and what else is known of it. A snapshot that nobody knows to be true is
/// what the robot believes (MatchFrame::truthKnown).
struct RobotFrame : sim::RobotSnapshot, RobotView {
  RobotKey key;      ///< who it is, whatever the source
  std::string name;  ///< robotName() of the key

  /// Number of its blackboard in a simulated match, for orders to it; 0 for robots of others.
  RobotId slot() const { return identity.id; }
};

}  // namespace pitchboard::link
