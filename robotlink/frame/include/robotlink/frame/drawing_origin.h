// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From where a layer that a robot's program drew counts its metres: one answer for the studio's
// field and for pictures made without a screen. A pure function.

#include <optional>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// In the studio's frame. `robot` may be null: it is not on the field. Nothing for what nobody
/// knows.
std::optional<Pose> drawingOrigin(telemetry::DrawingFrame frame, const RobotFrame* robot);

/// Programs of a simulated match name themselves by their slots: the frame's drawings get the keys
/// of those robots.
void keyDrawings(MatchFrame& frame);

}  // namespace pitchboard::link
