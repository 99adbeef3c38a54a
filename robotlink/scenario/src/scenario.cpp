// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

RuntimeChoice Scenario::runtimeOf(const ScenarioRobot& robot) const {
  if (robot.runtime.isChosen()) return robot.runtime;
  const auto team = runtimes.find(robot.identity.team);
  return team == runtimes.end() ? RuntimeChoice{} : team->second;
}

}  // namespace pitchboard::link
