// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Vision of a simulated robot: the head that searches and follows, the ball, other robots and the
// corners of the field.

#include <simcore/world/robot_io.h>

#include "rigid_body_tick.h"

namespace pitchboard::sim::rigid {

/// The number of ticks of the vision delay: the size of every robot's ring of sightings.
std::size_t delayTicks(const SimulationSettings& settings);

/// Moves the head and fills percept.landmarks, .ball, .robots and .searchOn. A robot that is down
/// sees nothing. The delay holds for the ball, which is what the head follows.
void stepVision(Tick& tick, std::size_t robot, const RobotCommand& command, Percepts& percept);

}  // namespace pitchboard::sim::rigid
