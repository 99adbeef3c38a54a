// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the two halves of the particle filter assume of the IMU. Constants only.

namespace pitchboard::link {

/// Share of IMU values that the filter takes for meaningless (a reset, a robot that was carried).
inline constexpr double imuOutliers = 0.05;

}  // namespace pitchboard::link
