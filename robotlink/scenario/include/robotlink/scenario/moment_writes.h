// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Scripted writes of a scenario that goes on from a later moment. Private to robotlink.

#include <algorithm>
#include <vector>

#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// Writes of the past stand at time 0, each variable's last; those of robots for which `plays` says
/// no are left out.
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
