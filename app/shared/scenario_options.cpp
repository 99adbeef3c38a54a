// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/scenario_options.h>

namespace pitchboard::shared {

void addScenarioOptions(CLI::App& command, ScenarioOptions& options) {
  command.add_option("--scenario", options.scenario, "Built-in name or a JSON file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of all noise; default: the scenario's")
      ->type_name("N");
  command.add_option("--noise", options.noise, "none, published, paper or realistic")
      ->type_name("PRESET");
  command.add_option("--physics", options.physics, "rigid-body or published")->type_name("MODEL");
}

Result<link::Scenario> changed(link::Scenario scenario, const ScenarioOptions& options) {
  if (options.seed) scenario.settings.seed = *options.seed;
  if (!options.physics.empty()) scenario.settings.physics = options.physics;
  if (!options.noise.empty()) {
    const auto noise = link::noisePreset(options.noise);
    if (!noise) return tl::unexpected<Error>(noise.error());
    scenario.settings.noise = *noise;
  }
  return scenario;
}

Result<link::Scenario> scenarioFrom(const ScenarioOptions& options) {
  auto scenario = link::loadScenario(options.scenario);
  if (!scenario) return scenario;
  return changed(std::move(*scenario), options);
}

}  // namespace pitchboard::shared
