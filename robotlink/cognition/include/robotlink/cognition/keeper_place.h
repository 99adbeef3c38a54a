// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes where a goalkeeper should stand. The keeper's behaviour uses it, and so do advisors to
// predict the opponents' keeper. Metres, radians; turned so that the keeper's own goal is at -x.
// Pure function; any thread.

#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

/// Returns the pose: on the line from the ball to the goal, where it crosses an arc in front of the
/// posts (BehaviourParameters::keeperLine, keeperArc), shifted sideways by keeperAside.
Pose keeperPlace(const sim::FieldSpec& field, const BehaviourParameters& numbers,
                 const Point& ball);

}  // namespace pitchboard::link
