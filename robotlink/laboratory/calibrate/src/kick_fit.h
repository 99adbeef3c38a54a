// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Kicks: how fast and where to the ball goes, when the foot hits it, how long the robot is busy,
// and how the ball rolls; and how long getting up takes. Private to calibrate.

#include <span>

#include <robotlink/calibrate/calibrate.h>

#include "motion_fit.h"

namespace pitchboard::link {

/// Adds values, or reasons, to `out` and sets them in its model.
void fitKicks(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
              const MotionFit& motion, Calibration& out);

}  // namespace pitchboard::link
