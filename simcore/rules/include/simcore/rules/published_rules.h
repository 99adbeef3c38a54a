// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The rules of the published simulator, for matches without a referee: goals count, and a ball that
// is out is put back. A pure function of the world's state and the path of the ball; metres, or the
// published frame if the world uses it. Any thread.

#include <vector>

#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

/// Goal when the ball crosses the goal line wholly between the posts; it counts while the clock
/// runs. Out when it is wholly over a line elsewhere: it is put back inside, at rest. What happened
/// is appended to `events`.
void applyPublishedRules(WorldState& world, const BallSweep& way, std::vector<Event>& events);

}  // namespace pitchboard::sim
