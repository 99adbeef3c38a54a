// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/scenario/team_programs.h>

#include <algorithm>

#include <base/try.h>

namespace pitchboard::link {

Result<bool> usesTeamPrograms(const Scenario& scenario) {
  bool any = false;
  for (const ScenarioRobot& robot : scenario.robots) {
    const RuntimeChoice choice = scenario.runtimeOf(robot);
    if (!choice.isChosen()) continue;
    const auto runtime = TRY(loadRuntime(choice));
    any = any || std::ranges::any_of(runtime.processes,
                                     [](const auto& one) { return !one.isReference(); });
  }
  return any;
}

}  // namespace pitchboard::link
