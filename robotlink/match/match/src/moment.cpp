// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/moment.h>

#include <algorithm>
#include <bit>

namespace pitchboard::link {

void MomentRobot::writeTo(Blackboard& board) const {
  // Every word can be written as the int variable with its index, independent of the catalog.
  for (const BoardWord& word : words) {
    board.write(IntVar{word.index}, std::bit_cast<std::int32_t>(word.bits));
  }
}

const MomentRobot* Moment::robot(RobotId id) const {
  const auto found = std::find_if(robots.begin(), robots.end(),
                                  [id](const MomentRobot& robot) { return robot.id == id; });
  return found == robots.end() ? nullptr : &*found;
}

}  // namespace pitchboard::link
