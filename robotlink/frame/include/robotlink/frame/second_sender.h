// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Two robots that are heard with the same number are two robots: the first one that is heard keeps
// the number as its id, the others get ids that no robot can have by right. The same in Live and in
// recordings of it. Pure functions.

#include <base/ids.h>

namespace pitchboard::link {

/// Robot n is RobotId n; a second sender of that number is n + 65536, the third n + 131072.
/// `isTaken(RobotId)` says which ids others have.
template <class IsTaken>
RobotId idOfSender(int number, IsTaken&& isTaken) {
  constexpr int step = 65536;
  RobotId id{number};
  while (isTaken(id)) id.value += step;
  return id;
}

}  // namespace pitchboard::link
