// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_reader.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <base/angles.h>
#include <base/byte_sizes.h>
#include <base/identifier.h>
#include <base/read_file.h>
#include <base/short_name.h>
#include <resources/resources.h>
#include <robotlink/experiment/run_result.h>
#include <simcore/world/limits.h>

namespace pitchboard::link {
namespace {

constexpr int experimentVersion = 1;
constexpr int maxRuns = 1'000'000;
constexpr std::size_t maxConditions = 1000, maxEntries = 1000, maxScenarioBytes = mebibyte;
constexpr double fastestMatch = 1000.0;  // times real time, of a team's own programs
constexpr double maxRun = 1e6;           // s
constexpr double fieldReach = 200.0;     // m; a place outside the walls is moved inside
constexpr std::array<std::string_view, 8> reductionNames{"mean", "min",      "max",     "first",
                                                         "last", "integral", "changes", "p95"};
constexpr std::array<std::string_view, 3> recordNames{"nothing", "failed", "all"};
constexpr std::array<std::string_view, 2> processesNames{"inline", "separate"};

/// An experiment has no teams, and says what a tournament knows by itself.
std::span<const std::string_view> keysOf(const JsonNode& root) {
  constexpr static std::array<std::string_view, 26> experiment{
      "version", "name",       "title",  "description", "scenario",
      "set",     "grid",       "random", "runs",        "common_random_numbers",
      "seed",    "conditions", "team",   "starts",      "placed",
      "stop",    "metrics",    "sample", "success",     "compare",
      "record",  "assertions", "paths",  "processes",   "speed",
      "rules"};
  constexpr static std::array<std::string_view, 22> tournament{
      "version", "name",   "title", "description", "scenario",   "set",       "random", "seed",
      "starts",  "placed", "stop",  "metrics",     "sample",     "record",    "paths",  "processes",
      "speed",   "teams",  "pairs", "matches",     "swap_sides", "assertions"};
  if (root.find("teams")) return tournament;
  return experiment;
}

}  // namespace

ExperimentReader::ExperimentReader(const JsonNode& root, JsonReport& report, std::string folder)
    : m_report(report), m_root(report, root, "", keysOf(root)), m_folder(std::move(folder)) {}

void ExperimentReader::read(Experiment& e, ConditionParts& parts) {
  m_root.require("version");
  const int version = m_root.integer("version", experimentVersion, 1, 1'000'000);
  if (version != experimentVersion) {
    m_root.fail("version", "is " + std::to_string(version) +
                               ", but this program reads version 1; a newer program wrote this");
  }
  e.name = readShortName(m_root, "name", e.name);
  e.title = m_root.text("title", "", 200);
  e.description = m_root.text("description", "", 5000);
  m_root.require("scenario");
  e.runs = static_cast<std::size_t>(m_root.integer("runs", 1, 1, maxRuns));
  e.seed = m_root.unsignedInteger("seed", e.seed);
  e.commonSeeds = m_root.boolean("common_random_numbers", true);
  std::vector<std::string_view> teams;
  for (const TeamColorInfo& color : teamColors) teams.push_back(color.name);
  const auto team = m_root.choice("team", teams, "team");
  e.success = m_root.text("success", e.success, 500);
  e.sampleEvery = m_root.number("sample", e.sampleEvery, {0.001, 3600, "seconds"});
  e.pathsShown = static_cast<std::size_t>(m_root.integer("paths", 30, 0, 1000));
  if (const auto processes = m_root.choice("processes", processesNames, "kind of processes")) {
    e.separateProcesses = *processes == 1;
  }
  e.speed = m_root.number("speed", e.speed, {0.1, fastestMatch, "times real time"});
  if (m_report.failed()) return;
  readScenario(parts);
  if (m_report.failed()) return;
  readConditions(parts);
  readRandom(e);
  readStarts(e);
  e.placed = placedOf(m_root);
  readStop(e, parts.stop);
  readMetrics(e);
  readGiven(e);
  readRecord(e);
  if (m_root.find("teams")) {
    readTournament(e);
  } else {
    readAssertions(e);
    readRules(e);
  }
  if (m_report.failed()) return;
  if (team) {
    e.team = teamColors[*team].color;
  } else if (const Json& robots = parts.scenario.value("robots", Json::array());
             !robots.empty() && robots[0].contains("team")) {
    const auto first = std::ranges::find(teams, robots[0]["team"].get<std::string>());
    if (first != teams.end()) e.team = teamColors[std::size_t(first - teams.begin())].color;
  }
}

/// Paths in the file are relative to its folder.
std::string ExperimentReader::pathOf(const std::string& name) const {
  return m_folder.empty() ? name : (std::filesystem::path(m_folder) / name).string();
}

void ExperimentReader::readScenario(ConditionParts& parts) {
  const JsonNode* node = m_root.find("scenario");
  if (node->kind == JsonNode::Kind::Object) {
    parts.scenario = jsonOf(*node);
    const auto whole = scenarioFromJson(parts.scenario.dump(), "scenario");
    if (!whole) return m_root.fail("scenario", whole.error().message);
    parts.stop = whole->stop;
    return;
  }
  const std::string name = m_root.text("scenario", "", 4096);
  if (m_report.failed()) return;
  const auto builtIn = builtInScenarios();
  const bool known =
      std::ranges::any_of(builtIn, [&](const ScenarioName& one) { return one.name == name; });
  const bool isPath = !known && name.find_first_of("/.") != std::string::npos;
  const std::string path = isPath ? pathOf(name) : name;
  const auto whole = loadScenario(path);
  if (!whole) return m_root.fail("scenario", whole.error().text());
  parts.stop = whole->stop;
  std::string text(resourceText("scenarios/" + name + ".json"));
  if (!known) {
    auto file = readFile(path, maxScenarioBytes, "the scenario");
    if (!file) return m_root.fail("scenario", file.error().text());
    text = std::move(*file);
  }
  JsonReport report(path);
  const auto root = parseJson(text, report);
  if (!root) return m_root.fail("scenario", report.error().text());
  parts.scenario = jsonOf(*root);
}

std::vector<ScenarioSetting> ExperimentReader::settingsOf(const JsonNode& node,
                                                          const std::string& path) {
  std::vector<ScenarioSetting> out;
  if (node.kind != JsonNode::Kind::Object) {
    m_report.fail(node.line, path, "must be an object: a value for each key of the scenario");
    return out;
  }
  for (const auto& [key, value] : node.members) {
    out.push_back({key, jsonOf(value).dump(), value.line});
  }
  return out;
}

void ExperimentReader::readConditions(ConditionParts& parts) {
  if (const JsonNode* set = m_root.find("set")) parts.common = settingsOf(*set, "set");
  const auto* items = m_root.array("conditions", maxConditions);
  for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
    const std::string path = m_root.pathOf("conditions", i);
    const JsonObject object(m_report, (*items)[i], path, {"name", "set", "placed"});
    object.require("name");
    ConditionParts::Named condition{
        object.text("name", "", 100), {}, placedOf(object), (*items)[i].line};
    if (condition.name.empty()) object.fail("name", "is empty");
    for (const auto& other : parts.named) {
      if (other.name == condition.name) object.fail("name", "another condition has this name");
    }
    if (const JsonNode* set = object.find("set")) {
      condition.settings = settingsOf(*set, path + ".set");
    }
    parts.named.push_back(std::move(condition));
  }
  const JsonNode* grid = m_root.find("grid");
  if (!grid || m_report.failed()) return;
  std::size_t product = std::max<std::size_t>(1, parts.named.size());
  const JsonObject varied(m_report, *grid, "grid");
  for (const auto& [key, values] : varied.members()) {
    if (values.kind != JsonNode::Kind::Array || values.items.empty()) {
      m_report.fail(values.line, "grid." + key, "must be a list of values");
      return;
    }
    product *= values.items.size();
    if (product > maxConditions) {
      m_report.fail(values.line, "grid." + key,
                    "gives more than " + std::to_string(maxConditions) + " conditions");
      return;
    }
    ConditionParts::Axis axis{key, {}, values.line};
    for (const JsonNode& value : values.items) axis.values.push_back(jsonOf(value).dump());
    parts.grid.push_back(std::move(axis));
  }
}

void ExperimentReader::readRandom(Experiment& e) {
  const JsonNode* node = m_root.find("random");
  if (!node || m_report.failed()) return;
  const JsonObject ranges(m_report, *node, "random");
  for (const auto& [key, value] : ranges.members()) {
    const JsonObject object(m_report, value, "random." + key, {"from", "to"});
    object.require("from");
    object.require("to");
    RandomSetting one{key, object.number("from", 0, anyNumber), object.number("to", 0, anyNumber),
                      value.line};
    if (one.to < one.from) object.fail("to", "is below \"from\"");
    e.random.push_back(std::move(one));
  }
}

void ExperimentReader::readStarts(Experiment& e) {
  const JsonNode* node = m_root.find("starts");
  if (!node || m_report.failed()) return;
  const JsonObject starts(m_report, *node, "starts");
  for (const auto& [who, value] : starts.members()) {
    const JsonObject object(m_report, value, "starts." + who, {"x", "y", "heading"});
    const NumberRange metres{0, 5, "metres"};
    e.starts.push_back({who, object.number("x", 0, metres), object.number("y", 0, metres),
                        object.number("heading", 0, {0, 180, "degrees"})});
    if (who == "ball" && object.find("heading")) object.fail("heading", "a ball has no heading");
  }
}

std::vector<PlacedByHand> ExperimentReader::placedOf(const JsonObject& parent) {
  std::vector<PlacedByHand> out;
  const auto* items = parent.array("placed", maxEntries);
  for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
    const JsonObject object(m_report, (*items)[i], parent.pathOf("placed", i),
                            {"time", "who", "x", "y", "heading", "vx", "vy"});
    for (const std::string_view key : {"time", "who", "x", "y"}) object.require(key);
    const NumberRange place{-fieldReach, fieldReach, "metres"};
    const NumberRange speed{-sim::fastestBall, sim::fastestBall, "metres per second"};
    PlacedByHand one;
    one.time = object.number("time", 0, {0, maxRun, "seconds"});
    one.who = object.text("who", "", 8);
    one.pose.position = {object.number("x", 0, place), object.number("y", 0, place)};
    one.pose.yaw = radiansFromDegrees(object.number("heading", 0, {-360, 360, "degrees"}));
    one.velocity = {object.number("vx", 0, speed), object.number("vy", 0, speed)};
    out.push_back(std::move(one));
  }
  return out;
}

void ExperimentReader::readStop(Experiment& e, const StopConditions& usual) {
  e.stop.duration = usual.duration.value_or(e.stop.duration);
  e.stop.goal = e.stop.goalAgainst = usual.goal;
  e.stop.ballOut = usual.ballOut;
  const JsonNode* node = m_root.find("stop");
  if (!node || m_report.failed()) return;
  const JsonObject object(m_report, *node, "stop",
                          {"duration", "goal", "goal_against", "ball_out", "fell", "stuck"});
  const NumberRange seconds{0.001, maxRun, "seconds"};
  e.stop.duration = object.number("duration", e.stop.duration, seconds);
  e.stop.goal = object.boolean("goal", e.stop.goal);
  e.stop.goalAgainst = object.boolean("goal_against", e.stop.goalAgainst);
  e.stop.ballOut = object.boolean("ball_out", e.stop.ballOut);
  e.stop.fell = object.boolean("fell", false);
  if (object.find("stuck")) e.stop.stuck = object.number("stuck", 60, seconds);
}

void ExperimentReader::readMetrics(Experiment& e) {
  const auto* items = m_root.array("metrics", 100);
  for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
    const JsonObject object(m_report, (*items)[i], m_root.pathOf("metrics", i),
                            {"name", "unit", "expression", "reduce"});
    for (const std::string_view key : {"name", "expression"}) object.require(key);
    ExpressionMetric metric;
    metric.name = object.text("name", "", 64);
    metric.unit = object.text("unit", "", 16);
    metric.expression = object.text("expression", "", 2000);
    if (!m_report.failed() && !isIdentifier(metric.name)) {
      object.fail("name", "must be letters, digits and '_', beginning with a letter");
    }
    if (const auto reduction = object.choice("reduce", reductionNames, "reduction")) {
      metric.reduction = static_cast<Reduction>(*reduction);
    }
    e.metrics.push_back(std::move(metric));
  }
}

void ExperimentReader::readGiven(Experiment& e) {
  const auto* items = m_root.array("compare", 100);
  for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
    const std::string path = m_root.pathOf("compare", i);
    const JsonObject object(m_report, (*items)[i], path,
                            {"name", "metric", "mean", "sd", "n", "conditions"});
    for (const std::string_view key : {"name", "metric", "mean", "n"}) object.require(key);
    GivenFigure figure;
    figure.name = object.text("name", "", 200);
    figure.metric = object.text("metric", "", 64);
    figure.mean = object.number("mean", 0, anyNumber);
    figure.count = static_cast<std::size_t>(object.integer("n", 2, 2, 1'000'000'000));
    if (object.find("sd")) figure.deviation = object.number("sd", 0, {0, 1e300, {}});
    const auto* names = object.array("conditions", maxConditions);
    for (std::size_t c = 0; names && c < names->size(); ++c) {
      if ((*names)[c].kind != JsonNode::Kind::Text) {
        object.fail("conditions", "must be a list of names");
        break;
      }
      figure.conditions.push_back((*names)[c].text);
    }
    e.given.push_back(std::move(figure));
  }
}

void ExperimentReader::readAssertions(Experiment& e) {
  const auto* items = m_root.array("assertions", maxEntries);
  for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
    const JsonNode& item = (*items)[i];
    if (item.kind == JsonNode::Kind::Text) {
      e.assertions.push_back({item.text, {}, item.line});
      continue;
    }
    const JsonObject object(m_report, item, m_root.pathOf("assertions", i), {"check", "condition"});
    object.require("check");
    e.assertions.push_back(
        {object.text("check", "", 500), object.text("condition", "", 300), item.line});
  }
}

/// Rules of severity error are assertions: never broken.
void ExperimentReader::readRules(Experiment& e) {
  const JsonNode* node = m_root.find("rules");
  if (!node || m_report.failed()) return;
  if (node->kind == JsonNode::Kind::Text) {
    auto rules = telemetry::rulesFromFile(pathOf(m_root.text("rules", "", 4096)));
    if (!rules) return m_root.fail("rules", rules.error().text());
    e.rules = std::move(*rules);
  } else {
    e.rules = telemetry::rulesOf(m_root, m_report);
  }
  for (const telemetry::Rule& rule : e.rules) {
    if (rule.severity != telemetry::RuleSeverity::Error) continue;
    e.assertions.push_back({"max(" + ruleMetric(rule) + ") == 0", {}, node->line});
  }
}

void ExperimentReader::readRecord(Experiment& e) {
  const JsonNode* node = m_root.find("record");
  if (!node || m_report.failed()) return;
  if (node->kind == JsonNode::Kind::Text) {
    if (const auto record = m_root.choice("record", recordNames, "value")) {
      e.record = static_cast<Record>(*record);
    }
    return;
  }
  const auto* items = m_root.array("record", maxEntries);
  for (std::size_t i = 0; items && i < items->size(); ++i) {
    if (!(*items)[i].whole || *(*items)[i].whole == 0) {
      return m_root.fail("record",
                         "must be \"nothing\", \"failed\", \"all\" or a list of numbers of runs");
    }
    e.recorded.push_back(static_cast<std::size_t>(*(*items)[i].whole));
  }
  e.record = Record::Chosen;
}

}  // namespace pitchboard::link
