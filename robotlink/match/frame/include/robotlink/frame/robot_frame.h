// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything that is known of a robot at one moment, whatever the source: pose, belief, what it
// sees, its link, cognition debug data, processes. Plain values in metres, radians and seconds;
// unknown values are empty. Any thread.

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

/// A ball as a robot sees it.
struct SeenBall {
  Point place;            ///< on the field, seen from the believed pose
  double distance = 0.0;  ///< m
  double bearing = 0.0;   ///< rad, left positive
  bool operator==(const SeenBall&) const = default;
};

/// The content of a received blackboard.
struct BoardContents {
  std::shared_ptr<const std::vector<std::string>> names;  ///< null if none is received
  std::vector<double> values;  ///< one per name; exact for every int32 and float32
};

/// What is known of a robot besides its true pose; made by buildRobot().
struct RobotView {
  /// Believed pose. If the true pose is known, only while localization works.
  std::optional<Pose> belief;
  std::optional<double> sigma;                ///< m, uncertainty of the belief
  std::optional<SeenBall> ball;               ///< nothing while the robot is offline
  std::optional<int> decided;                 ///< DECISION_ACTION_A
  std::optional<telemetry::Battery> battery;  ///< nothing if it sends no voltage
  /// In the order of telemetry::processNames.
  std::array<telemetry::ProcessHeartbeat, telemetry::processCount> lamps{};
  std::optional<telemetry::LinkHealth> link;  ///< of a live or attached robot
  std::optional<Penalty> penalty;             ///< from the referee
  std::vector<ReceivedValue> values;          ///< all values of its message, in order
  std::optional<int> boardKey;                ///< key of its blackboard; 0: on the heap
  BoardContents board;                        ///< if attached, or sent by its robot
  std::string behaviour;
  std::vector<std::string> programs;  ///< files of the team programs that run for it: "chase.py"
  std::string ownName;                ///< its name in the team setup
  std::string runtime;                ///< the runtime that was chosen for it; may be empty
  bool ofOthers = false;              ///< its processes, if any, were not started by us
  std::optional<CognitionDebug>
      cognitionDebug;  ///< particles and path, if it sends them (MatchOptions::cognitionDebug)
  /// Shared by many frames, because processes seldom change. Read it with processes().
  std::shared_ptr<const std::vector<ProcessStatus>> processList;

  /// Returns the processes that were started for it, in order.
  std::span<const ProcessStatus> processes() const {
    return processList ? std::span<const ProcessStatus>(*processList)
                       : std::span<const ProcessStatus>{};
  }
  /// Returns whether the robot was received but is offline now.
  bool timedOut() const { return link && link->timedOut; }
  /// Returns false for a received robot that has never reported its pose.
  bool poseKnown() const { return !link || belief; }
};

/// Everything that is known of a robot. If the truth is unknown (MatchFrame::truthKnown), the pose
/// of the snapshot is what the robot believes.
struct RobotFrame : sim::RobotSnapshot, RobotView {
  RobotUid uid;  ///< who it is, whatever becomes known of it; unique in a frame
  RobotKey key;  ///< the number and team under which it plays or sends now
  /// robotName() of the key. In a recording the name of its rows, if that tells it from another
  /// robot with its number: "B1 rerun".
  std::string name;

  /// Returns the number of its blackboard in a simulated match; 0 for other robots.
  RobotId slot() const { return identity.id; }
};

}  // namespace pitchboard::link
