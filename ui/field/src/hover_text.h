// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the field says of a robot or the ball when the mouse rests on it. Pure functions.

#include <QString>

#include <base/robot_key.h>

namespace pitchboard::link {
struct MatchFrame;
}

namespace pitchboard::ui {

/// Lines of plain text: name, behaviour, action, target, how far its belief is off, what is wrong.
/// Empty for a robot that is not in the frame.
QString hoverText(const link::MatchFrame& frame, RobotUid id);
/// Position (m) and speed (m/s) of the true ball, which the frame must know.
QString ballHoverText(const link::MatchFrame& frame);

}  // namespace pitchboard::ui
