// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which match is played, as every command that plays one is told: a scenario, and what is to be
// different in it. Used at the start of a program, in its first thread.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include <robotlink/scenario/scenario.h>

namespace pitchboard::shared {

struct ScenarioOptions : link::ScenarioOverrides {
  std::string scenario = "match";
  std::vector<std::string> robotModels;  ///< "kid-size", "red=my-robot.json"; the last one wins
  std::vector<std::string> advised;      ///< teams that think ahead: "blue"
};

/// --scenario, --seed, --noise, --physics, --robot-model and --advisor.
void addScenarioOptions(CLI::App& command, ScenarioOptions& options);

/// A check of options that take a whole number: what is wrong with one below 0, which would become
/// a huge one; empty when it is none.
std::string refuseNegative(const std::string& text);

/// Puts seed, noise, physics, robot models and advisors into a scenario.
Result<link::Scenario> changed(link::Scenario scenario, const ScenarioOptions& options);

/// What the scenario asks of its physics in vain, as warnings on stderr.
void warnOfIgnoredSettings(const link::Scenario& scenario);

/// The scenario that was named, changed. Errors as loadScenario() and noisePreset().
Result<link::Scenario> scenarioFrom(const ScenarioOptions& options);

}  // namespace pitchboard::shared
