// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The published simulator's match rules in metres, for any field.

#include <vector>

#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim::rigid {

/// How far inside the lines a ball that was out is put back, m (PUBLISHED_EXACT.md "Ball").
inline constexpr double replacementDistance = 1.0;

/// Goal when the ball is wholly over the goal line between the posts; it counts while the clock
/// runs. Out when it is wholly over a line elsewhere: it is put back inside, at rest.
/// `state` is the physics state of `world`; what happened is appended to `events`.
void applyMatchRules(WorldState& world, RigidBodyState& state, std::vector<Event>& events);

}  // namespace pitchboard::sim::rigid
