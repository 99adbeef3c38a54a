// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who a robot is, for its blackboard and its telemetry. See also <base/robot_key.h>.

#include <compare>

namespace pitchboard {

/// The number of a robot's blackboard and of its telemetry port: 1, 2, ... unique on one field.
/// (The number on its shirt is unique within its team only.)
struct RobotId {
  int value = 0;
  auto operator<=>(const RobotId&) const = default;
};

/// Robots with higher numbers have no blackboard and no telemetry port.
inline constexpr int highestRobotNumber = 64;

}  // namespace pitchboard
