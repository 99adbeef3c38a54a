// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Applies the rules of the published simulator, which hold in matches without a referee: goals
// count, and a ball that is out is put back. A pure function of the world's state and the path of
// the ball; metres, or the published frame if the world uses it. Any thread.

#include <vector>

#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

/// A goal is scored when the whole ball crosses the goal line between the posts; it counts only
/// while the clock runs. The ball is out when all of it has crossed a line elsewhere; it is put
/// back inside, at rest. Appends what happened to `events`.
void applyPublishedRules(WorldState& world, const BallSweep& sweep, std::vector<Event>& events);

}  // namespace pitchboard::sim
