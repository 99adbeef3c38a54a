// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

RuntimeChoice Scenario::runtimeOf(const ScenarioRobot& robot) const {
  return runtimeOf(robot.identity.team, robot.runtime);
}

RuntimeChoice Scenario::runtimeOf(TeamColor team, const RuntimeChoice& own) const {
  if (own.isChosen()) return own;
  const auto found = runtimes.find(team);
  return found == runtimes.end() ? RuntimeChoice{} : found->second;
}

}  // namespace pitchboard::link
