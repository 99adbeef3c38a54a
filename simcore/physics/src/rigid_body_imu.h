// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulated IMU: yaw with reset, white noise and drift, and what the other axes feel.

#include <simcore/world/robot_io.h>

#include "rigid_body_tick.h"

namespace pitchboard::sim::rigid {

/// m/s² in one g.
inline constexpr double gravity = 9.80665;

/// Draws the noise of all robots' IMUs in this tick, before the first stepImu().
void drawImu(Tick& tick, std::span<const RandomBatch::Tick> ahead = {});

/// Fills percept.imu. Yaw in (−π, π], relative to 180° for robots whose IMU starts there and to the
/// last reset; gyro in rad/s; accelerometer in g (what it feels: +1 upwards at rest), x forward and
/// y left. A robot on its front has a pitch of +90° and x = +1 g, on its back −90° and −1 g: the
/// sign by which real control chooses how to get up.
void stepImu(Tick& tick, std::size_t robot, const RobotCommand& command, ImuPercept& percept);

}  // namespace pitchboard::sim::rigid
