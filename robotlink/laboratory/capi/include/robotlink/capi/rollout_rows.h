// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts beliefs to and from rows of numbers with named
// columns, for programs in other languages. Metres, radians, seconds. Pure functions; any thread.

#include <cstddef>
#include <span>

#include <base/result.h>
#include <robotlink/capi/worlds.h>
#include <robotlink/rollout/rollouts.h>

namespace pitchboard::link {

// A belief has a row for each robot, and a row for ball and game.
std::span<const WorldColumn> beliefRobotColumns();
std::span<const WorldColumn> beliefGameColumns();

/// Returns the columns of what Rollouts::play() returns.
std::span<const WorldColumn> outcomeColumns();

/// Writes the rows of all robots to `robots` and the row of ball and game to `game`. Fails if a
/// size does not match.
Result<void> writeBelief(const rollout::Belief& belief, std::span<double> robots,
                         std::span<double> game);
/// Returns `belief` with the values of the rows; NaN keeps a value. Fails if a size does not match,
/// or if a number stands for no state, set play or side.
Result<rollout::Belief> readBelief(rollout::Belief belief, std::span<const double> robots,
                                   std::span<const double> game);

}  // namespace pitchboard::link
