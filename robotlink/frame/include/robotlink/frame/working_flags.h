// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// When a process of a robot works: its flag on the blackboard is set, or was a moment ago, because
// the flag is cleared and set again all the time. One rule for frames of simulated, attached and
// recorded robots and for reports. Any thread.

namespace pitchboard::link {

/// Seconds for which a process counts as working after its flag was last seen set.
inline constexpr double flagMemory = 1.0;

}  // namespace pitchboard::link
