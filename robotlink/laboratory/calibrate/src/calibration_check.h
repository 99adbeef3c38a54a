// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How well a calibration holds: predictions of what was not fitted, and the innovations of what
// was. Private to calibrate.

#include <span>

#include <robotlink/calibrate/calibrate.h>

#include "motion_fit.h"

namespace pitchboard::link {

/// Windows of 5 s of the held-out part (of everything where nothing was held out), begun at the
/// filtered state and played with the recorded commands by both models.
void checkPredictions(std::span<const CalibrationLog> logs, double holdOut, const MotionFit& motion,
                      Calibration& out);
void describeResiduals(const MotionFit& motion, Calibration& out);

}  // namespace pitchboard::link
