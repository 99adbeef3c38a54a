// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/drawing_origin.h>

namespace pitchboard::link {

std::optional<Pose> drawingOrigin(telemetry::DrawingFrame frame, const RobotFrame* robot) {
  if (frame == telemetry::DrawingFrame::Field) return Pose{};
  if (robot == nullptr || !robot->poseKnown()) return std::nullopt;
  if (frame == telemetry::DrawingFrame::Belief) return robot->belief.value_or(robot->pose);
  return robot->pose;
}

void keyDrawings(MatchFrame& frame) {
  for (telemetry::RobotDrawings& drawn : frame.drawings) {
    if (const RobotFrame* robot = frame.robot(RobotId{drawn.robot.number}))
      drawn.robot = robot->key;
  }
}

}  // namespace pitchboard::link
