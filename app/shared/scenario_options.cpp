// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/scenario_options.h>
#include <app/usage.h>
#include <base/try.h>
#include <robotlink/models/robot_models.h>

#include <cstdio>

namespace pitchboard::shared {

namespace {

/// "NAME", "FILE", "TEAM=NAME" or "TEAM=FILE".
Result<void> chooseModel(link::Scenario& scenario, const std::string& text) {
  const TeamColorInfo* only = nullptr;
  std::string name = text;
  for (const TeamColorInfo& team : teamColors) {
    const std::string start = std::string(team.name) + '=';
    if (!text.starts_with(start)) continue;
    only = &team;
    name = text.substr(start.size());
  }
  const auto model = TRY(link::loadRobotModel(name));
  bool any = false;
  for (link::ScenarioRobot& robot : scenario.robots) {
    if (only && robot.identity.team != only->color) continue;
    robot.model = model;
    any = true;
  }
  if (only && !any) {
    return failure(ErrorCode::NotFound,
                   "team " + std::string(only->name) + " has no robot in this scenario",
                   "--robot-model " + text);
  }
  return {};
}

}  // namespace

std::string refuseNegative(const std::string& text) {
  return text.starts_with('-') ? "must be 0 or more, not " + text : std::string();
}

void addScenarioOptions(CLI::App& command, ScenarioOptions& options) {
  command.add_option("--scenario", options.scenario, "Built-in scenario or a JSON file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of the noise; default: the scenario's")
      ->check(refuseNegative)
      ->type_name("N");
  command
      .add_option("--noise", options.noise,
                  "Noise: none, published, paper, realistic, or robot (that of each robot's model)")
      ->type_name("PRESET");
  command.add_option("--physics", options.physics, "Physics engine: rigid-body or published")
      ->type_name("MODEL");
  command
      .add_option("--robot-model", options.robotModels,
                  "Model of all robots, or with blue= or red= of one team: published, darwin-op, "
                  "kid-size, adult-size or a file; may be repeated")
      ->type_name("[TEAM=]NAME|FILE");
  addGroup(command, "Models", {"--physics", "--robot-model"});
  std::vector<std::string> colours;
  for (const TeamColorInfo& team : teamColors) colours.emplace_back(team.name);
  command
      .add_option("--advisor", options.advised,
                  "Let this team think ahead (docs/advisor.md); may be repeated")
      ->type_name("TEAM")
      ->check(CLI::IsMember(colours));
}

Result<link::Scenario> changed(link::Scenario scenario, const ScenarioOptions& options) {
  scenario = TRY(link::changed(std::move(scenario), options));
  for (const std::string& text : options.robotModels) {
    TRY(chooseModel(scenario, text));
  }
  for (const std::string& team : options.advised) {
    scenario.advisors.try_emplace(teamColorNamed(team).value());
  }
  return scenario;
}

void warnOfIgnoredSettings(const link::Scenario& scenario) {
  std::vector<sim::RobotModel> models;
  for (const link::ScenarioRobot& robot : scenario.robots) models.push_back(robot.model);
  for (const std::string& sentence : sim::ignoredSettings(scenario.settings, models)) {
    std::fprintf(stderr, "warning: %s\n", sentence.c_str());
  }
}

Result<link::Scenario> scenarioFrom(const ScenarioOptions& options) {
  auto scenario = link::loadScenario(options.scenario);
  if (!scenario) return scenario;
  return changed(std::move(*scenario), options);
}

}  // namespace pitchboard::shared
