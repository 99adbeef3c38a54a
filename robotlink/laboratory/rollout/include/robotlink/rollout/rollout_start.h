// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Prepares rollouts from a scenario. Pure function; any thread.

#include <robotlink/rollout/rollouts.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// The players, and the beginning of the scenario as a belief with an uncertainty of a decimetre.
struct RolloutStart {
  rollout::Setup setup;
  rollout::Belief belief;
};

/// Robots whose behaviour does not use the pose ("none", "naive") stand still in rollouts.
RolloutStart rolloutStartOf(const Scenario& scenario, double tickRate = 20.0);

}  // namespace pitchboard::link
