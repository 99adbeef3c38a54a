// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// At which pace a match goes on that slows down to what a team's own programs manage. Pure; any
// thread. Speeds are times real time.

#include <algorithm>
#include <chrono>
#include <optional>

namespace pitchboard::link {

/// Between two changes of the pace, so that a new one shows what it does.
inline constexpr std::chrono::seconds ownPaceInterval{3};

/// `slowest`: what the slowest program manages; nothing: all keep up.
inline double paceWithOwnPrograms(double wanted, double now, std::optional<double> slowest) {
  constexpr double faster = 1.25, least = 0.1;
  return slowest ? std::max(least, std::min(*slowest, wanted)) : std::min(wanted, now * faster);
}

}  // namespace pitchboard::link
