// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/pose_difference.h>

#include <cmath>

#include <base/angles.h>

namespace pitchboard::ui {

std::optional<PoseDifference> poseDifference(const link::MatchFrame& other, RobotId id,
                                             const Pose& here) {
  const link::RobotFrame* robot = other.robot(id);
  if (robot == nullptr || !robot->poseKnown() || robot->timedOut()) return std::nullopt;
  return PoseDifference{robot->pose, distance(robot->pose.position, here.position),
                        std::abs(wrapToPi(robot->pose.yaw - here.yaw))};
}

QString differenceText(const PoseDifference& difference) {
  return QStringLiteral("%1 cm %2°")
      .arg(std::lround(difference.metres * 100))
      .arg(std::lround(degreesFromRadians(difference.radians)));
}

}  // namespace pitchboard::ui
