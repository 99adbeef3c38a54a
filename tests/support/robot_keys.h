// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keys of robots as tests write them.

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

}  // namespace pitchboard
