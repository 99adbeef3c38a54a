// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who a robot is, for everything that shows or stores robots, whatever their source.

#include <compare>

namespace pitchboard {

/// One robot of a match: simulated, live or recorded.
struct RobotKey {
  int team = 0;    ///< place in the source's table of teams, from 1; 0: not known yet
  int number = 0;  ///< on the shirt; 0: no robot
  int sender = 0;  ///< 0: the first program that uses the number; 1, 2, ...: others
  auto operator<=>(const RobotKey&) const = default;
};

}  // namespace pitchboard
