// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keys and uids of robots as tests write them.

#include <cstdint>

#include <base/robot_key.h>

namespace pitchboard {

/// B1, B2, ... of a simulated match; also of the first team setup.
constexpr RobotKey blue(int number) {
  return {1, number, 0};
}
constexpr RobotKey red(int number) {
  return {2, number, 0};
}
/// A live robot whose team nobody knows.
constexpr RobotKey receivedAs(int number, int sender = 0) {
  return {0, number, sender};
}

/// The robot with this slot of a simulated match.
constexpr RobotUid inSlot(int slot) {
  return {static_cast<std::uint32_t>(slot)};
}
/// The robot of a frame that has this key now; none: RobotUid{}.
template <class Frame>
RobotUid uidIn(const Frame& frame, const RobotKey& key) {
  const auto* robot = frame.robot(key);
  return robot != nullptr ? robot->uid : RobotUid{};
}

}  // namespace pitchboard
