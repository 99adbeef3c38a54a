// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What control really did in every row. CONTROL_ACTION is the command, which a robot that kicks,
// lies or gets up does not follow (docs/reference/SYSTEM.md, section 3). Private to calibrate.

#include <cstddef>
#include <vector>

#include <robotlink/calibrate/calibration_log.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

struct ExecutedAction {
  int code = 0;
  int b = 0;           ///< DECISION_ACTION_B when the action began
  bool kicks = false;  ///< busy with the kick `code`
  bool down = false;   ///< lies or gets up, or has just got up
  bool began = false;  ///< the first row of this action
};

/// One entry for each row.
std::vector<ExecutedAction> executedActions(const CalibrationLog& log, const sim::RobotModel& base);

}  // namespace pitchboard::link
