// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Two robots that are heard with the same number are two robots: the first one that is heard keeps
// the number as its id, the others get ids that no robot can have by right. The same in Live and in
// recordings of it. Pure functions.

#include <base/ids.h>

namespace pitchboard::link {

inline constexpr int senderStep = 65536;

/// Of the program in this slot of a number (telemetry::RobotStatus): slot 0 is the robot itself.
constexpr RobotId idOfSlot(int number, int slot) {
  return RobotId{number + senderStep * slot};
}
constexpr int slotOf(RobotId id) {
  return (id.value - 1) / senderStep;
}
constexpr int numberOf(RobotId id) {
  return (id.value - 1) % senderStep + 1;
}

/// Robot n is RobotId n; a second sender of that number is n + 65536, the third n + 131072.
/// `isTaken(RobotId)` says which ids others have.
template <class IsTaken>
RobotId idOfSender(int number, IsTaken&& isTaken) {
  RobotId id{number};
  while (isTaken(id)) id.value += senderStep;
  return id;
}

}  // namespace pitchboard::link
