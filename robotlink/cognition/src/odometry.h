// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Odometry of a robot without encoders: the speed that the gait has for the action that control
// carries out. Metres and radians per second in the robot's frame.

#include <base/angles.h>
#include <simcore/world/action.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {

struct GaitSpeed {
  double forward = 0.0;   ///< m/s
  double left = 0.0;      ///< m/s
  double turn = 0.0;      ///< rad/s
  bool inMotion = false;  ///< the legs move, also in place
};

/// `action` as in CONTROL_ACTION, `b` as in DECISION_ACTION_B (speed of slow walking below 10).
inline GaitSpeed gaitSpeed(int action, int b) {
  const sim::Action* entry = sim::findAction(action);
  if (entry == nullptr) return {};
  const bool moves = entry->kind == ActionKind::Walk || entry->kind == ActionKind::InPlace;
  constexpr int walkSlow = 8, fixedFrom = 10;
  constexpr double slowStep = 0.015;  // cm per frame for each unit of B
  const double front = action == walkSlow && b < fixedFrom ? slowStep * b : entry->front;
  return {sim::published_frame::mpsFromCmPerFrame(front),
          sim::published_frame::mpsFromCmPerFrame(entry->drift),
          radiansFromDegrees(entry->turn) * sim::published_frame::framesPerSecond, moves};
}

}  // namespace pitchboard::link
