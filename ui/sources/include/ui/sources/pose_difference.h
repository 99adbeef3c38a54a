// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How far apart two sources see the same robot: truth and what is heard of it, for instance.

#include <QString>
#include <optional>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

struct PoseDifference {
  Pose other;
  double metres = 0.0;
  double radians = 0.0;  ///< of the heading, 0 to π
};

/// Robots are the same when they have the same telemetry port: a live robot's number is a simulated
/// one's slot. Nothing when the other source does not know this robot's pose, or has not heard it
/// for long.
std::optional<PoseDifference> poseDifference(const link::MatchFrame& other,
                                             const link::RobotFrame& here);
/// "12 cm 4°".
QString differenceText(const PoseDifference& difference);

}  // namespace pitchboard::ui
