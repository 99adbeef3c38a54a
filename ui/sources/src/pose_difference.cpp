// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/pose_difference.h>

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <telemetry/monitor/team_setup.h>

namespace pitchboard::ui {

namespace {

/// 1240 + this is its port; 0: it has none.
int portOf(const link::RobotFrame& robot) {
  if (robot.slot().value != 0) return robot.slot().value;
  const bool isOfAnyTeam = robot.key.team <= 1 || robot.key.team == telemetry::simulatedTeam;
  return isOfAnyTeam && robot.key.sender == 0 ? robot.key.number : 0;
}

}  // namespace

std::optional<PoseDifference> poseDifference(const link::MatchFrame& other,
                                             const link::RobotFrame& here) {
  const int port = portOf(here);
  const auto robot = std::ranges::find(other.robots, port, portOf);
  if (port == 0 || robot == other.robots.end() || !robot->poseKnown() || robot->timedOut()) {
    return std::nullopt;
  }
  return PoseDifference{robot->pose, distance(robot->pose.position, here.pose.position),
                        std::abs(wrapToPi(robot->pose.yaw - here.pose.yaw))};
}

QString differenceText(const PoseDifference& difference) {
  return QStringLiteral("%1 cm %2°")
      .arg(std::lround(difference.metres * 100))
      .arg(std::lround(degreesFromRadians(difference.radians)));
}

}  // namespace pitchboard::ui
