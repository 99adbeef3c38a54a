// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What control does for each code of <simcore/world/action_codes.h>. Speeds are the published ones,
// in centimetres and degrees per frame of 1/60 s. Constant data; any thread.

#include <simcore/world/action_codes.h>

namespace pitchboard::sim {

/// When and how hard a kick acts. Angles are degrees from the heading, as published.
struct KickRule {
  double rightLimit = 0.0;  ///< reaches this far to the right of the heading ...
  double leftLimit = 0.0;   ///< ... and this far to the left
  double direction = 0.0;   ///< direction of the ball, added to the heading
  double strength = 0.0;    ///< L in force = min(10, L·exp(−((13 − d)/L)²)) cm/frame
  double share = 1.0;       ///< share of that force; weak kicks use half
};

struct Action : ActionInfo {
  double front = 0.0;  ///< cm per frame, forward positive
  double turn = 0.0;   ///< degrees per frame, left positive
  double drift = 0.0;  ///< cm per frame, to the LEFT positive (published sign: x −= sin·d)
  KickRule kick;
  bool inPublishedModel = true;  ///< the published simulator knows the code
};

/// Returns the entry of a code, or null if it is unknown.
const Action* findAction(int code);

}  // namespace pitchboard::sim
