// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Body of the `published` model: move, control and the ball (published-exact.md, sections "Move",
// "Control", "Ball").

#include <vector>

#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>

#include <simcore/world/published_geometry.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim::published {

void moveRobot(WorldState& world, const PublishedGeometry& geometry, std::size_t index);

void controlRobot(WorldState& world, const PublishedGeometry& geometry, std::size_t index,
                  const RobotCommand& command, Percepts& percepts, std::vector<Event>& events);

/// Slows and moves the ball and bounces it off posts and walls; says where it came from.
BallSweep moveBall(WorldState& world, const PublishedGeometry& geometry);

}  // namespace pitchboard::sim::published
