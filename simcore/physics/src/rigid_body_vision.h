// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Vision of a simulated robot: the head that searches and follows, the ball, other robots and the
// corners of the field.

#include <simcore/world/robot_io.h>

#include "rigid_body_tick.h"

namespace pitchboard::sim::rigid {

/// Ticks from the moment in which robot `index` takes an image to that in which it is told.
std::size_t delayTicks(const WorldState& world, std::size_t index);
/// The longest of all robots: the size of the ring of past moments.
std::size_t maxDelay(const WorldState& world);
/// Makes the ring fit the delays and the robots; moments that it has are kept.
void resizePast(WorldState& world, RigidBodyState& state);

/// Draws the noise with which all robots see the ball, in the tick itself done by stepVision(), for
/// ticks `ahead`.
void drawSight(Tick& tick, std::span<const RandomBatch::Tick> ahead);

/// Moves the head and fills percept.landmarks, .ball, .robots and .searchOn. What is seen is the
/// world as it was before the vision delay; what is looked for is what the robot wants now, and a
/// robot that is down sees nothing.
void stepVision(Tick& tick, std::size_t robot, const RobotCommand& command, Percepts& percept);

/// After all robots have looked: keeps this moment for the delay to come.
void remember(Tick& tick);

}  // namespace pitchboard::sim::rigid
