// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/scenario/scenario.h>

#include <base/try.h>

namespace pitchboard::link {

Result<Scenario> changed(Scenario scenario, const ScenarioOverrides& overrides) {
  if (overrides.seed) scenario.settings.seed = *overrides.seed;
  if (!overrides.physics.empty()) scenario.settings.physics = overrides.physics;
  if (!overrides.noise.empty()) scenario.settings.noise = TRY(noisePreset(overrides.noise));
  if (!(overrides.duration >= 0.0 && overrides.duration <= 1e9)) {
    return failure(ErrorCode::InvalidArgument,
                   "duration must be above 0 and at most 1e9 seconds, or 0 for the scenario's");
  }
  if (overrides.duration > 0.0) scenario.stop.duration = overrides.duration;
  return scenario;
}

Result<std::size_t> Scenario::robotNamed(std::string_view name) const {
  std::string names;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::string one = robots[i].identity.name();
    if (one == name) return i;
    names += (names.empty() ? "; there are: " : ", ") + one;
  }
  return failure(ErrorCode::NotFound,
                 "there is no robot \"" + std::string(name) + "\" in this scenario" + names);
}

RuntimeChoice Scenario::runtimeOf(const ScenarioRobot& robot) const {
  return runtimeOf(robot.identity.team, robot.runtime);
}

RuntimeChoice Scenario::runtimeOf(TeamColor team, const RuntimeChoice& own) const {
  if (own.isChosen()) return own;
  const auto found = runtimes.find(team);
  return found == runtimes.end() ? RuntimeChoice{} : found->second;
}

}  // namespace pitchboard::link
