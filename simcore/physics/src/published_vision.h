// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Eyes of the `published` model (published-exact.md, sections "Landmark vision", "Ball vision",
// "Robot vision").

#include <simcore/world/robot_io.h>
#include <simcore/world/world_state.h>

#include <simcore/world/published_geometry.h>

namespace pitchboard::sim::published {

/// DECISION_LOCALIZATION: bearings of the corners, or a look at the ball.
void landmarkVision(const WorldState& world, const PublishedGeometry& geometry, std::size_t index,
                    const RobotCommand& command, Percepts& percepts);

/// DECISION_ACTION_VISION: ball, team-mates or opponents; moves the head.
void sight(WorldState& world, std::size_t index, const RobotCommand& command, Percepts& percepts);

}  // namespace pitchboard::sim::published
