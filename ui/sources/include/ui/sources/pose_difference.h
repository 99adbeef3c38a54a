// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The difference between the poses of a robot in two sources, such as its true and its received
// pose. Pure functions; any thread.

#include <QString>
#include <optional>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

struct PoseDifference {
  Pose other;
  double metres = 0.0;
  double radians = 0.0;  ///< difference in yaw, 0 to π
};

/// Robots correspond if they have the same telemetry port: the number of a live robot is the id of
/// a simulated one. Empty if the other source has no pose of this robot, or if the robot is
/// offline.
std::optional<PoseDifference> poseDifference(const link::MatchFrame& other,
                                             const link::RobotFrame& here);
/// "12 cm 4°".
QString differenceText(const PoseDifference& difference);

}  // namespace pitchboard::ui
