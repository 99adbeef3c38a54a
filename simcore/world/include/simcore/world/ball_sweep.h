// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How the ball moved in one tick, as the rules need it: with where it lies afterwards it says which
// line it crossed, however long the tick and however fast the ball. Metres, the studio's frame; a
// plain value of one tick.

#include <base/geometry.h>

namespace pitchboard::sim {

struct BallSweep {
  Point from;  ///< where it was when the tick began
  Point aim;   ///< where it would have gone with nothing in its way
};

}  // namespace pitchboard::sim
