// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The gait of a robot model, without noise. Private to calibrate; pure.

#include <simcore/world/gait_step.h>
#include <simcore/world/robot_model.h>

#include "executed_actions.h"

namespace pitchboard::link {

/// Speeds of the gait, which approach those of the action step by step. m/s and rad/s.
struct GaitStep {
  double forward = 0.0, left = 0.0, turn = 0.0;
  bool moves = false;  ///< the legs move, so that there is motion noise

  void advance(const sim::RobotModel& model, const ExecutedAction& action, double dt) {
    sim::GaitSpeed target;
    if (!action.kicks && !action.down) target = sim::gaitSpeed(model, action.code, action.b);
    moves = target.inMotion;
    forward = sim::approach(forward, target.forward, model.maxAcceleration * dt);
    left = sim::approach(left, target.left, model.maxAcceleration * dt);
    turn = sim::approach(turn, target.turn, model.maxYawAcceleration * dt);
  }
};

}  // namespace pitchboard::link
