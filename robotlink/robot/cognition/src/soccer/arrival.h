// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How long robots need to a place: what decides who goes to the ball. Everybody of a team computes
// the same from what the team tells. Metres, radians, seconds; pure functions.

#include "soccer/world_model.h"

namespace pitchboard::link {

/// m/s
double walkingSpeed(const WorldModel& world);

/// How much farther it is to a ball from where a robot has to go round it before it can play
/// towards the opponents' goal, m.
double pathLengthAround(const Point& robot, const Point& ball);

/// This robot, from where it stands and looks, to `place`.
double secondsTo(const WorldModel& world, const Point& place);
/// A robot of the same kind at `from`, of which nobody knows where it looks.
double secondsFrom(const WorldModel& world, const Point& from, const Point& place);

/// The same to play a ball that lies, or will lie, at `ball`.
double secondsToBall(const WorldModel& world, const Point& ball);
double secondsToBallFrom(const WorldModel& world, const Point& from, const Point& ball);

}  // namespace pitchboard::link
