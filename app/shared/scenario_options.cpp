// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/option_arguments.h>
#include <app/scenario_options.h>
#include <app/usage.h>
#include <base/lined_json.h>
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
  const std::size_t equals = text.find('=');
  const auto loaded = link::loadRobotModel(name);
  if (!loaded && !only && equals != std::string::npos) {
    std::vector<std::string_view> teams;
    for (const TeamColorInfo& team : teamColors) teams.push_back(team.name);
    return failure(ErrorCode::NotFound, unknownName("team", text.substr(0, equals), teams),
                   "--robot-model " + text);
  }
  const auto model = TRY(loaded);
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

template <auto member>
constexpr OptionAccess<ScenarioOptions> scenarioMember = optionMember<ScenarioOptions, member>;

// clang-format off
constexpr Option<ScenarioOptions> scenarioTable[] = {
    {{.name = "scenario", .form = "NAME|FILE", .text = "Built-in scenario or a JSON file"},
      scenarioMember<&ScenarioOptions::scenario>},
    {{.name = "seed", .form = "N", .text = "Seed of the noise; default: the scenario's"},
      scenarioMember<&ScenarioOptions::seed>},
    {{.name = "noise", .form = "PRESET",
      .text = "Noise: none, published, paper, realistic, or robot (that of each robot's model)"},
      scenarioMember<&ScenarioOptions::noise>},
    {{.name = "physics", .form = "MODEL", .text = "Physics engine: rigid-body or published"},
      scenarioMember<&ScenarioOptions::physics>},
    {{.name = "robot-model", .form = "[TEAM=]NAME|FILE",
      .text = "Model of all robots, or with blue= or red= of one team: published, darwin-op, "
              "kid-size, adult-size or a file"}, scenarioMember<&ScenarioOptions::robotModels>},
    {{.name = "advisor", .form = "TEAM",
      .text = "Let the keeper of this team learn where the opponents aim (docs/advisor.md)"},
      scenarioMember<&ScenarioOptions::advised>},
};
// clang-format on

}  // namespace

void addScenarioOptions(CLI::App& command, ScenarioOptions& options) {
  addOptions(command, scenarioTable, options);
  addGroup(command, "Models", {"--physics", "--advisor"});
  std::vector<std::string> colours;
  for (const TeamColorInfo& team : teamColors) colours.emplace_back(team.name);
  command.get_option("--advisor")->check(CLI::IsMember(colours));
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
