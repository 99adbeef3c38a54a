// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Scripted writes of a scenario that continues from a later moment. Private to robotlink.

#include <algorithm>
#include <vector>

#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// Returns the writes: past ones are at time 0, only the last of each variable. Those of robots for
/// which `plays` returns false are left out.
template <class Plays>
std::vector<BlackboardWrite> writesFrom(const std::vector<BlackboardWrite>& writes, double now,
                                        Plays&& plays) {
  std::vector<BlackboardWrite> out;
  for (BlackboardWrite write : writes) {
    if (write.robot.value != 0 && !plays(write.robot)) continue;
    write.time = std::max(0.0, write.time - now);
    if (write.time == 0.0) {
      std::erase_if(out, [&](const BlackboardWrite& earlier) {
        return earlier.time == 0.0 && earlier.robot == write.robot &&
               earlier.variable == write.variable;
      });
    }
    out.push_back(std::move(write));
  }
  return out;
}

}  // namespace pitchboard::link
