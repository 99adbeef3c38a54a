// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options of all commands that play a match: the scenario, and values that replace those of the
// scenario. Used at the start of a program, on its main thread.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include <robotlink/scenario/scenario.h>

namespace pitchboard::shared {

struct ScenarioOptions : link::ScenarioOverrides {
  std::string scenario = "match";
  std::vector<std::string> robotModels;  ///< "kid-size", "red=my-robot.json"; the last one wins
  std::vector<std::string> advised;      ///< teams whose keeper has an advisor: "blue"
};

/// Adds --scenario, --seed, --noise, --physics, --robot-model and --advisor.
void addScenarioOptions(CLI::App& command, ScenarioOptions& options);

/// Applies seed, noise, physics, robot models and advisors to a scenario.
Result<link::Scenario> changed(link::Scenario scenario, const ScenarioOptions& options);

/// Prints a warning to stderr for each value of the scenario that its physics ignores.
void warnOfIgnoredSettings(const link::Scenario& scenario);

/// Loads the scenario and applies the options. Fails as loadScenario() and noisePreset() do.
Result<link::Scenario> scenarioFrom(const ScenarioOptions& options);

}  // namespace pitchboard::shared
