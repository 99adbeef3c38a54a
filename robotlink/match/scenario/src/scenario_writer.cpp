// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <robotlink/models/model_json.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/world/field_text.h>
#include <simcore/world/referee_parameters.h>

#include "game_json.h"
#include "scenario_keys.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

Json fieldToJson(const sim::FieldSpec& field) {
  const std::string text = sim::fieldToText(field);
  return text.starts_with('{') ? Json::parse(text, nullptr, false) : Json(text);
}

Json behaviourToJson(const ScenarioRobot& robot) {
  const std::string text = behaviourToText(robot.behaviour, robot.parameters);
  return text.starts_with('{') ? Json::parse(text, nullptr, false) : Json(text);
}

Json rigidBodyToJson(const sim::RigidBodySettings& body, const sim::FieldSpec& field) {
  sim::RigidBodySettings usual;
  usual.ballMass = field.ballMass;
  Json out = Json::object();
  if (body.falls != usual.falls) out[sim::fallsSwitch.key] = body.falls;
  out.update(numbersToJson(differences(sim::rigidBodyParameters, body, usual)));
  return out;
}

Json refereeToJson(const sim::RefereeRules& rules) {
  std::string base;
  Json least;
  for (const RuleSetInfo& set : refereeRuleSets()) {
    const auto built = refereeRuleSet(set.name);
    if (!built || !*built) continue;
    if (**built == rules) return set.name;
    Json changed = numbersToJson(differences(sim::refereeCounts, rules, **built));
    changed.update(numbersToJson(differences(sim::refereeParameters, rules, **built)));
    for (const auto& one : sim::refereeSwitches) {
      if (rules.*one.member != (**built).*one.member) changed[one.key] = rules.*one.member;
    }
    if (rules.style != (**built).style) continue;
    if (base.empty() || changed.size() < least.size() || rules.name == set.name) {
      base = set.name;
      least = std::move(changed);
      if (rules.name == set.name) break;
    }
  }
  Json out{{"rules", base}};
  out.update(least);
  return out;
}

/// Writes at time 0 that stand in the order in which the reader would take them from the robots'
/// own "blackboard" objects; the rest goes into "writes".
std::size_t addBlackboards(const Scenario& scenario, Json& robots) {
  std::size_t taken = 0;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    Json board = Json::object();
    while (taken < scenario.writes.size()) {
      const BlackboardWrite& write = scenario.writes[taken];
      if (write.robot != scenario.robots[i].identity.id || write.time != 0.0 ||
          board.contains(write.variable)) {
        break;
      }
      board[write.variable] = jsonNumber(write.value);
      ++taken;
    }
    if (!board.empty()) robots[i]["blackboard"] = std::move(board);
  }
  return taken;
}

Json robotToJson(const ScenarioRobot& robot, std::size_t index) {
  const TeamColorInfo& team = info(robot.identity.team);
  Json out{{"team", team.name},
           {"number", robot.identity.number},
           {"x", jsonNumber(robot.pose.position.x)},
           {"y", jsonNumber(robot.pose.position.y)},
           {"heading", jsonNumber(fileDegrees(robot.pose.yaw))},
           {"behaviour", behaviourToJson(robot)}};
  if (robot.model != sim::RobotModel{}) out["model"] = robotModelToJson(robot.model);
  if (robot.identity.id.value != static_cast<int>(index) + 1) out["id"] = robot.identity.id.value;
  if (robot.identity.imuStartsAt180 != team.facesLeft) {
    out["imu_starts_at_180"] = robot.identity.imuStartsAt180;
  }
  if (robot.runtime.isChosen()) out["runtime"] = runtimeChoiceToText(robot.runtime);
  if (const auto& belief = robot.belief) {
    out["belief"] = {{"x", jsonNumber(belief->pose.position.x)},
                     {"y", jsonNumber(belief->pose.position.y)},
                     {"heading", jsonNumber(fileDegrees(belief->pose.yaw))},
                     {"sigma", jsonNumber(belief->sigma)}};
  }
  return out;
}

void addAdvisor(const Scenario& scenario, TeamColor colour, Json& team) {
  const auto found = scenario.advisors.find(colour);
  if (found == scenario.advisors.end()) return;
  team["advisor"] = true;
  if (const std::string& memory = found->second.memory; !memory.empty()) {
    team["advisor"] = {{"memory", memory}};
  }
}

}  // namespace

std::string scenarioToJson(const Scenario& scenario) {
  const sim::SimulationSettings& settings = scenario.settings;
  Json out{{"version", scenarioVersion},
           {"name", scenario.name},
           {"title", scenario.title},
           {"description", scenario.description},
           {"physics", settings.physics},
           {"tick_rate", jsonNumber(settings.tickRate)},
           {"seed", settings.seed},
           {"after_goal", afterGoalNames[static_cast<std::size_t>(settings.afterGoal)]},
           {"clock_running", scenario.clockRunning}};
  if (scenario.clock != 0.0) out["clock"] = jsonNumber(scenario.clock);
  if (scenario.score != sim::Score{}) {
    out["score"] = {{"left", scenario.score.left}, {"right", scenario.score.right}};
  }
  out["field"] = fieldToJson(settings.field);
  out["noise"] = noiseToJson(settings.noise);
  if (Json body = rigidBodyToJson(settings.rigidBody, settings.field); !body.empty()) {
    out["rigid_body"] = std::move(body);
  }
  if (settings.referee) out["referee"] = refereeToJson(*settings.referee);
  if (scenario.game) out["game"] = gameStartToJson(*scenario.game, scenario);
  for (const sim::TeamSettings& team : settings.teams) {
    Json one{{"colour", info(team.colour).name}};
    if (team.number != 0) one["number"] = team.number;
    if (!team.name.empty()) one["name"] = team.name;
    addAdvisor(scenario, team.colour, one);
    out["teams"].push_back(std::move(one));
  }
  for (const auto& [colour, options] : scenario.advisors) {
    if (std::ranges::find(settings.teams, colour, &sim::TeamSettings::colour) !=
        settings.teams.end()) {
      continue;
    }
    Json one{{"colour", info(colour).name}};
    addAdvisor(scenario, colour, one);
    out["teams"].push_back(std::move(one));
  }
  Json ball{{"x", jsonNumber(scenario.ball.x)}, {"y", jsonNumber(scenario.ball.y)}};
  if (scenario.ballVelocity != Velocity{}) {
    ball["vx"] = jsonNumber(scenario.ballVelocity.x);
    ball["vy"] = jsonNumber(scenario.ballVelocity.y);
  }
  out["ball"] = std::move(ball);

  for (const auto& [team, choice] : scenario.runtimes) {
    out["runtime"][info(team).name] = runtimeChoiceToText(choice);
  }
  Json robots = Json::array();
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    robots.push_back(robotToJson(scenario.robots[i], i));
    if (scenario.game) addGameOf(*scenario.game, scenario.robots[i].identity.id, robots.back());
  }
  const std::size_t onBoards = addBlackboards(scenario, robots);
  out["robots"] = std::move(robots);

  Json writes = Json::array();
  for (std::size_t i = onBoards; i < scenario.writes.size(); ++i) {
    const BlackboardWrite& write = scenario.writes[i];
    Json entry{{"time", jsonNumber(write.time)}};
    if (write.robot.value != 0) entry["robot"] = write.robot.value;
    entry["variable"] = write.variable;
    entry["value"] = jsonNumber(write.value);
    writes.push_back(std::move(entry));
  }
  if (!writes.empty()) out["writes"] = std::move(writes);

  Json stop = Json::object();
  if (scenario.stop.duration) stop["duration"] = jsonNumber(*scenario.stop.duration);
  if (scenario.stop.goal) stop["goal"] = true;
  if (scenario.stop.ballOut) stop["ball_out"] = true;
  if (!stop.empty()) out["stop"] = std::move(stop);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace pitchboard::link
