// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/scenario/team_programs.h>

#include <algorithm>

#include <base/try.h>

namespace pitchboard::link {

Result<bool> usesTeamPrograms(const Scenario& scenario, bool separate, std::string_view remedy) {
  for (const ScenarioRobot& robot : scenario.robots) {
    const RuntimeChoice choice = scenario.runtimeOf(robot);
    if (!choice.isChosen()) continue;
    const auto runtime = TRY(loadRuntime(choice));
    const auto& all = runtime.processes;
    if (std::ranges::all_of(all, [](const auto& one) { return one.isReference(); })) {
      continue;
    }
    if (separate) return true;
    return failure(ErrorCode::InvalidArgument,
                   robot.identity.name() + " is played by a team program (" +
                       runtimeChoiceToText(choice) + "), which only runs as a separate process; " +
                       std::string(remedy));
  }
  return false;
}

}  // namespace pitchboard::link
