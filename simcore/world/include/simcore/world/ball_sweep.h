// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The motion of the ball in one tick. Together with the position after the tick, the rules find out
// from it which line the ball crossed, even in a long tick or at high speed. Metres, the studio's
// frame. A plain value; any thread.

#include <base/geometry.h>

namespace pitchboard::sim {

struct BallSweep {
  Point from;  ///< position at the beginning of the tick
  Point aim;   ///< position that it would have reached without obstacles
};

}  // namespace pitchboard::sim
