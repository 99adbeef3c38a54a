// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Facts about the robot of a group, written by their names in files.

#include <telemetry/series/group_attributes.h>

namespace pitchboard::telemetry {

inline std::optional<RobotFacts> facts(const GroupAttributes& attributes) {
  GroupInfo group;
  readAttributes(attributes, group);
  return group.robot;
}

}  // namespace pitchboard::telemetry
