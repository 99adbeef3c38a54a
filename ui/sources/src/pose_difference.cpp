// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/pose_difference.h>

#include <cmath>

#include <base/angles.h>

namespace pitchboard::ui {

std::optional<PoseDifference> poseDifference(const link::MatchFrame& other, RobotId id,
                                             const Pose& here) {
  for (std::size_t i = 0; i < other.snapshot.robots.size(); ++i) {
    const sim::RobotSnapshot& robot = other.snapshot.robots[i];
    if (robot.identity.id != id) continue;
    if (i < other.health.size() && (!other.health[i].poseKnown || other.health[i].timedOut)) {
      return std::nullopt;
    }
    return PoseDifference{robot.pose, distance(robot.pose.position, here.position),
                          std::abs(wrapToPi(robot.pose.yaw - here.yaw))};
  }
  return std::nullopt;
}

QString differenceText(const PoseDifference& difference) {
  return QStringLiteral("%1 cm %2°")
      .arg(std::lround(difference.metres * 100))
      .arg(std::lround(degreesFromRadians(difference.radians)));
}

}  // namespace pitchboard::ui
