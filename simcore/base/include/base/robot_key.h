// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Identifies a robot for everything that shows or stores robots, whatever their source. Values.

#include <compare>
#include <cstdint>

namespace pitchboard {

/// Which number of which team a robot plays, or sends, at a moment. Another robot can have it
/// later: a referee corrects colours, a second program takes over a number.
struct RobotKey {
  int team = 0;    ///< index in the source's table of teams, from 1; 0: unknown
  int number = 0;  ///< number on the shirt; 0: no robot
  int sender = 0;  ///< 0: the first program with that number; 1, 2, ...: others
  auto operator<=>(const RobotKey&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// Identifies a robot of a source for as long as the source exists, even if its key, name, colour
/// or address changes: a simulated robot by its slot (RobotId), a live robot from its first
/// datagram on (RobotUids), a recorded robot as it was identified when it was recorded. 0: none.
struct RobotUid {
  std::uint32_t value = 0;
  auto operator<=>(const RobotUid&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The order in which robots are listed, on the screen and in files: our team before the others,
/// then by team, number and sender.
struct RobotOrder {
  bool isTheirs = true;
  RobotKey robot;
  auto operator<=>(const RobotOrder&) const = default;  // NOLINT(modernize-use-nullptr)
};

}  // namespace pitchboard
