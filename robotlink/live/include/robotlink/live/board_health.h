// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot whose blackboard is read on this computer, as Live and recordings show it: what its board
// says becomes health, believed pose and ball, as if it had been heard. Pure functions.

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// The id of such a robot is its number and this: no robot that is heard, and no second sender of
/// its number, has it.
inline constexpr int attachedStep = 65536 * 1000;

constexpr bool isAttached(RobotId id) {
  return id.value > attachedStep;
}

/// Of the board of this number, when the other ids of the frame are taken.
template <class IsTaken>
RobotId idOfBoard(int number, IsTaken&& isTaken) {
  RobotId id{number + attachedStep};
  while (isTaken(id)) id.value += 1000;
  return id;
}

}  // namespace pitchboard::link
