// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a position is worth at the end of a rollout: the goals that one's own team will score more
// than the other within the next 30 s, on average. Metres, m/s; pure.

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

struct Position {
  Point ball;  ///< turned so that the own team attacks towards +x
  Velocity velocity;
  double near = 10.0;        ///< m from where the ball comes to rest to the nearest of the own team
  double theirsNear = 10.0;  ///< m, of the others
};

double positionValue(const sim::FieldSpec& field, const Position& position);

}  // namespace pitchboard::link
