// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Body of the `published` model: move, control and the ball (PUBLISHED_EXACT.md, sections "Move",
// "Control", "Ball").

#include <vector>

#include <simcore/physics/simulation.h>

#include "published_geometry.h"

namespace pitchboard::sim::published {

void moveRobot(WorldState& world, const PublishedGeometry& geometry, std::size_t index);

void controlRobot(WorldState& world, const PublishedGeometry& geometry, std::size_t index,
                  const RobotCommand& command, Percepts& percepts, std::vector<Event>& events);

void moveBall(WorldState& world, const PublishedGeometry& geometry, std::vector<Event>& events);

}  // namespace pitchboard::sim::published
