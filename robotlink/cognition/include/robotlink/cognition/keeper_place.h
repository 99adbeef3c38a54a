// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a keeper stands: for the behaviour itself, and for advisors that watch the opponents'
// keeper. Metres, radians, turned so that its own goal is at -x. A pure function; any thread.

#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

/// On the line from the ball to the goal, on an arc before it that covers the posts, and aside from
/// there (BehaviourParameters::keeperLine, keeperArc, keeperAside).
Pose keeperPlace(const sim::FieldSpec& field, const BehaviourParameters& numbers,
                 const Point& ball);

}  // namespace pitchboard::link
