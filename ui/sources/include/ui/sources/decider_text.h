// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who decides for a robot, as cards and tips say it. Pure; any thread.

#include <QString>

#include <robotlink/frame/robot_frame.h>

namespace pitchboard::ui {

/// Returns "chase.py" if a team's programs run, otherwise the behaviour, "Striker"; empty if it is
/// unknown.
QString deciderText(const link::RobotFrame& robot);

}  // namespace pitchboard::ui
