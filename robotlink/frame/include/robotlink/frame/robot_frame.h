// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All that is known of one robot at one moment: how it stands, what its blackboard says, how it is
// heard, what it has in mind, which of its processes run. Plain values.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/robot_key.h>
#include <robotlink/cognition/robot_thoughts.h>
#include <robotlink/frame/live_values.h>
#include <robotlink/processes/process_manager.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::link {

/// What its blackboard, or its last message, says.
struct RobotBoardView {
  int key = 0;      ///< System V key, 0 = heap
  int actionA = 0;  ///< DECISION_ACTION_A
  int voltage = 0;  ///< tenths of a volt
  bool visionLost = false;
  float ballDistCm = 0.0F;  ///< VISION_BALL_DIST
  float panDeg = 0.0F;      ///< VISION_PAN_DEG
  int localizationX = 0, localizationY = 0, localizationTheta = 0;
  float belief = 0.0F;  ///< cm
  /// communication, vision, localization, decision, IMU: *_WORKING seen set within the last second
  /// (communication has no flag: running child process).
  bool controlWorking = false, visionWorking = false, localizationWorking = false,
       decisionWorking = false, imuWorking = false;
  std::string behaviour;
};

/// A robot's snapshot, and what else is known of it. A snapshot that nobody knows to be true is
/// what the robot believes (MatchFrame::truthKnown).
struct RobotFrame : sim::RobotSnapshot {
  RobotKey key;                           ///< who it is, whatever the source
  std::string name;                       ///< robotName() of the key
  std::optional<RobotBoardView> board;    ///< nothing: nobody knows it
  std::optional<RobotHealth> health;      ///< of a robot that is heard by network
  std::optional<Penalty> penalty;         ///< of a simulated referee
  std::optional<RobotThoughts> thoughts;  ///< of one that tells it (MatchOptions::thoughts)
  /// Shared by many frames: processes seldom change. Read with processes().
  std::shared_ptr<const std::vector<ProcessStatus>> processList;

  std::string ownName;    ///< what its team calls it (team setups); empty: nothing known
  std::string runtime;    ///< who runs, as it was chosen for it; empty: nothing was
  bool ofOthers = false;  ///< its processes were started by somebody else, if by anybody

  /// Number of its blackboard in a simulated match, for orders to it; 0 for robots of others.
  RobotId slot() const { return identity.id; }
  /// Those that were started for it, in order.
  std::span<const ProcessStatus> processes() const {
    return processList ? std::span<const ProcessStatus>(*processList)
                       : std::span<const ProcessStatus>{};
  }
  /// It is heard, but not lately.
  bool timedOut() const { return health && health->timedOut; }
  /// False for one that is heard and never said where it is.
  bool poseKnown() const { return !health || health->poseKnown; }
};

}  // namespace pitchboard::link
