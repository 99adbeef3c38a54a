// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Control of a simulated robot: which action it carries out, how fast that makes it walk and turn,
// kicks, falling and getting up.

#include <simcore/world/robot_io.h>

#include "rigid_body_tick.h"

namespace pitchboard::sim::rigid {

/// How long a fallen robot lies before control notices by itself and gets up (the mean of
/// IMU_ACCEL_Z has to fall first), s.
inline constexpr double lyingTime = 0.5;

/// Draws the noise of all robots' motion in this tick, before the first stepControl(), or that of
/// ticks `ahead`.
void drawMotion(Tick& tick, std::span<const RandomBatch::Tick> ahead = {});

/// Selects the action as the published state machine does (published-exact.md "Control"), kicks,
/// changes the speeds within the gait's acceleration and turns the robot; leaves the velocity that
/// it asks for in its Motion. Fills percept.control.
void stepControl(Tick& tick, std::size_t robot, const RobotCommand& command, Percepts& percept);

/// Throws down the robot if what hit it in this tick was strong enough.
void applyFall(Tick& tick, std::size_t robot);

/// Whether the robot lies on the field or is just getting up.
inline bool isDown(const RigidRobot& robot) {
  return robot.posture != Posture::Upright;
}

/// Whether a robot that is down lies on its front.
bool liesOnFront(const RigidRobot& robot);

}  // namespace pitchboard::sim::rigid
