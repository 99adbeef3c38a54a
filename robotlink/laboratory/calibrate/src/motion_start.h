// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a robot is when a recording begins, or after it was carried: an extended Kalman filter
// needs a pose that is nearly right. Private to calibrate; pure.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include <robotlink/calibrate/calibration_log.h>
#include <simcore/world/robot_model.h>

#include "executed_actions.h"

namespace pitchboard::link {

struct MotionStart {
  std::uint32_t row = 0;
  Pose pose{};
  /// Of x, y and yaw. Zero if the pose is unknown, so that corners cannot be used.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// From the corners that it sees within some seconds from `row`. Nothing if they do not tell its
/// place well. `gaitSpread`: standard deviation of the logarithm of the model's speeds. `delay`: s
/// between an image and its percepts.
std::optional<MotionStart> startFromCorners(const CalibrationLog& log,
                                            const std::vector<ExecutedAction>& actions,
                                            const sim::RobotModel& model, double gaitSpread,
                                            double delay, std::uint32_t row);

MotionStart startFromBelief(std::uint32_t row, const CalibrationRow::Belief& belief);

}  // namespace pitchboard::link
