// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts drawings of robots' programs (docs/drawings.md) to the frame in which they are shown.
// The studio's field and pictures made without a screen both use it. Pure functions; any thread.

#include <optional>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// Returns the origin of a layer in the studio's frame. Empty if it is unknown; `robot` is null for
/// a robot that is not on the field.
std::optional<Pose> drawingOrigin(telemetry::DrawingFrame frame, const RobotFrame* robot);

/// Drawings in a simulated match name the robot by the number of its blackboard. Replaces these
/// numbers by the keys of the robots.
void keyDrawings(MatchFrame& frame);

}  // namespace pitchboard::link
