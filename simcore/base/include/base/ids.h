// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The number of a robot's blackboard and telemetry (see also <base/robot_key.h>). Plain values.

#include <compare>

namespace pitchboard {

/// The number of a robot's blackboard and telemetry port: 1, 2, ..., unique on a field. (The number
/// on its shirt is unique within its team only.)
struct RobotId {
  int value = 0;
  auto operator<=>(const RobotId&) const = default;
};

/// Robots with higher numbers have no blackboard and no telemetry port.
inline constexpr int highestRobotNumber = 64;

}  // namespace pitchboard
