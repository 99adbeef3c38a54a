// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/world/referee_parameters.h>

#include "scenario_keys.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a decimal point, as people write them.
Json number(double value) {
  constexpr double exact = 9007199254740992.0;  // 2^53
  if (value > -exact && value < exact) {
    const auto whole = static_cast<std::int64_t>(value);
    if (static_cast<double>(whole) == value && !(value == 0.0 && std::signbit(value))) return whole;
  }
  return value;
}

template <class Values, std::size_t N>
Json differences(const std::array<sim::Parameter<Values>, N>& parameters, const Values& value,
                 const Values& base) {
  Json out = Json::object();
  for (const auto& p : parameters) {
    const double stored = value.*p.member;
    if (stored == base.*p.member) continue;
    out[p.key] = number(p.unit.angle ? fileDegrees(stored) : stored);
  }
  return out;
}

Json fieldToJson(const sim::FieldSpec& field) {
  const sim::FieldSpec* base = nullptr;
  Json least;
  for (const sim::FieldSpec& built : sim::builtInFields()) {
    if (built == field) return field.name;
    Json changed = differences(sim::fieldParameters, field, built);
    if (!base || changed.size() < least.size()) {
      base = &built;
      least = std::move(changed);
    }
  }
  Json out{{"name", field.name}, {"base", base->name}};
  out.update(least);
  return out;
}

Json noiseToJson(const sim::NoiseParameters& noise) {
  std::string base;
  Json least;
  for (const std::string& name : noisePresets()) {
    const auto preset = noisePreset(name);
    if (!preset) continue;
    if (*preset == noise) return name;
    Json changed = differences(sim::noiseParameters, noise, *preset);
    if (base.empty() || changed.size() < least.size()) {
      base = name;
      least = std::move(changed);
    }
  }
  Json out{{"preset", base}};
  out.update(least);
  return out;
}

Json rigidBodyToJson(const sim::RigidBodySettings& body) {
  const sim::RigidBodySettings usual;
  Json out = Json::object();
  if (body.falls != usual.falls) out[sim::fallsSwitch.key] = body.falls;
  out.update(differences(sim::rigidBodyParameters, body, usual));
  return out;
}

Json refereeToJson(const sim::RefereeRules& rules) {
  std::string base;
  Json least;
  for (const RuleSetInfo& set : refereeRuleSets()) {
    const auto built = refereeRuleSet(set.name);
    if (!built || !*built) continue;
    if (**built == rules) return set.name;
    Json changed = differences(sim::refereeParameters, rules, **built);
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
      board[write.variable] = number(write.value);
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
           {"x", number(robot.pose.position.x)},
           {"y", number(robot.pose.position.y)},
           {"heading", number(fileDegrees(robot.pose.yaw))},
           {"behaviour", robot.behaviour}};
  if (robot.identity.id.value != static_cast<int>(index) + 1) out["id"] = robot.identity.id.value;
  if (robot.identity.imuStartsAt180 != team.facesLeft) {
    out["imu_starts_at_180"] = robot.identity.imuStartsAt180;
  }
  return out;
}

}  // namespace

std::string fieldToText(const sim::FieldSpec& field) {
  const Json json = fieldToJson(field);
  return json.is_string() ? json.get<std::string>()
                          : json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string scenarioToJson(const Scenario& scenario) {
  const sim::SimulationSettings& settings = scenario.settings;
  Json out{{"version", scenarioVersion},
           {"name", scenario.name},
           {"title", scenario.title},
           {"description", scenario.description},
           {"physics", settings.physics},
           {"tick_rate", number(settings.tickRate)},
           {"seed", settings.seed},
           {"after_goal", afterGoalNames[static_cast<std::size_t>(settings.afterGoal)]},
           {"clock_running", scenario.clockRunning}};
  if (scenario.clock != 0.0) out["clock"] = number(scenario.clock);
  if (scenario.score != sim::Score{}) {
    out["score"] = {{"left", scenario.score.left}, {"right", scenario.score.right}};
  }
  out["field"] = fieldToJson(settings.field);
  out["noise"] = noiseToJson(settings.noise);
  if (Json body = rigidBodyToJson(settings.rigidBody); !body.empty()) {
    out["rigid_body"] = std::move(body);
  }
  if (settings.referee) out["referee"] = refereeToJson(*settings.referee);
  Json ball{{"x", number(scenario.ball.x)}, {"y", number(scenario.ball.y)}};
  if (scenario.ballVelocity != Velocity{}) {
    ball["vx"] = number(scenario.ballVelocity.x);
    ball["vy"] = number(scenario.ballVelocity.y);
  }
  out["ball"] = std::move(ball);

  Json robots = Json::array();
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    robots.push_back(robotToJson(scenario.robots[i], i));
  }
  const std::size_t onBoards = addBlackboards(scenario, robots);
  out["robots"] = std::move(robots);

  Json writes = Json::array();
  for (std::size_t i = onBoards; i < scenario.writes.size(); ++i) {
    const BlackboardWrite& write = scenario.writes[i];
    Json entry{{"time", number(write.time)}};
    if (write.robot.value != 0) entry["robot"] = write.robot.value;
    entry["variable"] = write.variable;
    entry["value"] = number(write.value);
    writes.push_back(std::move(entry));
  }
  if (!writes.empty()) out["writes"] = std::move(writes);

  Json stop = Json::object();
  if (scenario.stop.duration) stop["duration"] = number(*scenario.stop.duration);
  if (scenario.stop.goal) stop["goal"] = true;
  if (scenario.stop.ballOut) stop["ball_out"] = true;
  if (!stop.empty()) out["stop"] = std::move(stop);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace pitchboard::link
