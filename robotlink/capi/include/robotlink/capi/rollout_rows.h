// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rollouts of a scenario's robots, and beliefs as rows of numbers with named columns, for programs
// that have no C++. Metres, radians, seconds. Pure functions; any thread.

#include <cstddef>
#include <span>

#include <base/result.h>
#include <robotlink/capi/worlds.h>
#include <robotlink/rollout/rollouts.h>

namespace pitchboard::link {

/// Who plays, and the beginning of the scenario as if it were known to a decimetre.
struct RolloutStart {
  rollout::Setup setup;
  rollout::Belief belief;
};

/// Robots that play by no behaviour with a pose ("none", "naive") stand in a rollout.
RolloutStart rolloutStartOf(const Scenario& scenario, double tickRate = 20.0);

/// The columns of a robot's row of a belief, and of the one row of ball and game.
std::span<const WorldColumn> beliefRobotColumns();
std::span<const WorldColumn> beliefGameColumns();

/// Those of what Rollouts::play() gives.
std::span<const WorldColumn> outcomeColumns();

/// Rows of all robots, one after the other, and the row of ball and game. Fails on other sizes.
Result<void> writeBelief(const rollout::Belief& belief, std::span<double> robots,
                         std::span<double> game);
/// NaN leaves what stands in `belief`. Fails on other sizes, and on words that do not exist (a
/// state, a set play, a side).
Result<rollout::Belief> readBelief(rollout::Belief belief, std::span<const double> robots,
                                   std::span<const double> game);

}  // namespace pitchboard::link
