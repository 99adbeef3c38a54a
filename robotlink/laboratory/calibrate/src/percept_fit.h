// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What vision's hits and misses tell, given the poses that the motion filter found: how often a
// thing in view is missed, field of view and range, noise on other robots. Private to calibrate.

#include <span>

#include <robotlink/calibrate/calibrate.h>

#include "motion_fit.h"

namespace pitchboard::link {

/// Adds values, or reasons, to `out` and sets them in its model.
void fitPercepts(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
                 const MotionFit& motion, Calibration& out);

/// One estimated number: into the model, and its interval into the list.
void take(Calibration& out, CalibratedValue value);

}  // namespace pitchboard::link
