// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/drawing_origin.h>

#include <robotlink/frame/belief.h>

namespace pitchboard::link {

std::optional<Pose> drawingOrigin(telemetry::DrawingFrame frame, const RobotFrame* robot,
                                  const sim::FieldSpec& field) {
  if (frame == telemetry::DrawingFrame::Field) return Pose{};
  if (robot == nullptr || !robot->poseKnown()) return std::nullopt;
  if (frame == telemetry::DrawingFrame::Belief) return perceivingPose(field, *robot);
  return robot->pose;
}

void keyDrawings(MatchFrame& frame) {
  for (telemetry::RobotDrawings& drawn : frame.drawings) {
    if (const RobotFrame* robot = frame.robot(RobotId{drawn.robot.number}))
      drawn.robot = robot->key;
  }
}

}  // namespace pitchboard::link
