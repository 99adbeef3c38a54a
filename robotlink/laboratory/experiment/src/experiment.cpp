// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/experiment/checks.h>
#include <robotlink/experiment/experiment.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <base/angles.h>
#include <base/random.h>
#include <base/read_file.h>
#include <resources/resources.h>
#include <robotlink/scenario/team_programs.h>

#include "experiment_reader.h"
#include "tournament_parts.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t maxFileBytes = mebibyte;
constexpr std::string_view experimentsFolder = "experiments/", situationsFolder = "situations/";

// No robot has this number, so that no noise of the run shares its draws.
constexpr int noRobot = -1;

double drawn(std::uint64_t seed, std::size_t which, double from, double to) {
  CounterRandom random(seed, noRobot, NoiseStream::Behaviour, which);
  return from + (to - from) * random.uniform();
}

std::string shown(const std::string& json) {
  return json.size() >= 2 && json.front() == '"' ? json.substr(1, json.size() - 2) : json;
}

/// The setting that a refused scenario complains about, else the last.
const ScenarioSetting* blamed(const std::vector<ScenarioSetting>& settings,
                              const std::string& message) {
  const ScenarioSetting* best = settings.empty() ? nullptr : &settings.back();
  for (const ScenarioSetting& setting : settings) {
    if (message.starts_with(setting.key)) best = &setting;
  }
  return best;
}

bool makeCondition(Condition& condition, const Json& base, int line, JsonReport& report) {
  Json patched = base;
  const std::string path = "condition \"" + condition.name + '"';
  for (const ScenarioSetting& setting : condition.settings) {
    if (auto put = putValue(patched, setting.key, Json::parse(setting.value)); !put) {
      report.fail(setting.line, path, setting.key + ": " + put.error().message);
      return false;
    }
  }
  condition.json = patched.dump();
  auto scenario = scenarioFromJson(condition.json, "scenario");
  if (!scenario) {
    const ScenarioSetting* setting = blamed(condition.settings, scenario.error().message);
    report.fail(setting ? setting->line : line, path, scenario.error().message);
    return false;
  }
  condition.scenario = std::move(*scenario);
  condition.scenario.stop = {};
  return true;
}

/// Each named condition (or one without a name) with each combination of the grid.
bool makeConditions(Experiment& e, const ConditionParts& parts, JsonReport& report) {
  std::vector<ConditionParts::Named> named = parts.named;
  if (named.empty()) named.push_back({});
  std::size_t combinations = 1;
  for (const auto& axis : parts.grid) combinations *= axis.values.size();
  for (const auto& one : named) {
    for (std::size_t combination = 0; combination < combinations; ++combination) {
      Condition condition{one.name, parts.common, {}, {}, e.placed};
      condition.team = one.team.value_or(e.team);
      condition.placed.insert(condition.placed.end(), one.placed.begin(), one.placed.end());
      std::ranges::stable_sort(condition.placed,
                               [](const auto& a, const auto& b) { return a.time < b.time; });
      condition.settings.insert(condition.settings.end(), one.settings.begin(), one.settings.end());
      std::size_t rest = combination, block = combinations;
      for (const auto& axis : parts.grid) {
        block /= axis.values.size();
        const std::string& value = axis.values[rest / block];
        rest %= block;
        condition.settings.push_back({axis.key, value, axis.line});
        condition.name += (condition.name.empty() ? "" : ", ") + axis.key + " = " + shown(value);
      }
      if (condition.name.empty()) condition.name = "as the scenario";
      if (!makeCondition(condition, parts.scenario, one.line, report)) return false;
      e.conditions.push_back(std::move(condition));
    }
  }
  return true;
}

/// Both ends of each range and a value between them, in each condition: what a run would be refused
/// for is said before any is played.
bool checkRandom(const Experiment& e, JsonReport& report) {
  constexpr double inside = 0.381966;  // no whole number where the ends are
  for (const Condition& condition : e.conditions) {
    const Json base = Json::parse(condition.json);
    for (const RandomSetting& setting : e.random) {
      for (const double share : {0.0, inside, 1.0}) {
        const double value = std::lerp(setting.from, setting.to, share);
        Json patched = base;
        Result<void> usable = putValue(patched, setting.key, value);
        if (usable) {
          auto scenario = scenarioFromJson(patched.dump(), "scenario");
          if (!scenario) usable = tl::unexpected(scenario.error());
        }
        if (usable) continue;
        report.fail(setting.line, "random." + setting.key,
                    shortest(value) + " cannot be used in condition \"" + condition.name +
                        "\": " + usable.error().message);
        return false;
      }
    }
  }
  return true;
}

/// Team programs decide how runs are played and which metrics they have.
void findTeamPrograms(Experiment& e, const JsonObject& root) {
  for (Condition& condition : e.conditions) {
    const auto own = usesTeamPrograms(condition.scenario);
    if (!own) return root.fail("scenario", "runtime: " + own.error().text());
    condition.teamPrograms = *own;
  }
}

/// What can only be judged once everything has been read.
void checkWhole(const Experiment& e, const JsonObject& root) {
  const std::vector<MetricInfo> metrics = metricsOf(e);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (metrics[i].name == metrics[j].name) {
        root.fail("metrics", "\"" + metrics[i].name + "\" is already the name of a metric");
      }
    }
  }
  const Scenario& scenario = e.conditions.front().scenario;
  for (const StartSpread& start : e.starts) {
    if (start.who == "ball" || start.who == "robots") continue;
    const auto robot = scenario.robotNamed(start.who);
    if (!robot) root.fail("starts", robot.error().message + "; or use ball or robots");
  }
  for (const Condition& condition : e.conditions) {
    for (const PlacedByHand& placed : condition.placed) {
      if (placed.who == "ball") continue;
      const auto robot = condition.scenario.robotNamed(placed.who);
      if (!robot) root.fail("placed", robot.error().message + "; or use ball");
    }
  }
  for (const ExpressionMetric& metric : e.metrics) {
    if (const auto parsed = telemetry::Expression::parse(metric.expression); !parsed) {
      root.fail("metrics", metric.name + ": " + parsed.error().message);
    }
  }
  if (const auto success = Check::parse(e.success, Check::Over::Run, metrics); !success) {
    root.fail("success", success.error().message);
  }
  const auto isCondition = [&e](const std::string& name) {
    return std::ranges::any_of(e.conditions,
                               [&](const Condition& one) { return one.name == name; });
  };
  for (const GivenFigure& figure : e.given) {
    std::vector<std::string_view> names;
    for (const MetricInfo& metric : metrics) names.push_back(metric.name);
    const auto metric = std::ranges::find(names, figure.metric);
    if (metric == names.end()) {
      root.fail("compare", unknownName("metric", figure.metric, names));
    } else if (metrics[std::size_t(metric - names.begin())].rate) {
      if (figure.mean < 0.0 || figure.mean > 1.0) {
        root.fail("compare", figure.name + ": the mean of a rate must be 0 to 1");
      }
    } else if (!figure.deviation) {
      root.fail("compare", figure.name + " needs \"sd\", its standard deviation");
    }
    for (const std::string& condition : figure.conditions) {
      if (!isCondition(condition)) root.fail("compare", "there is no condition " + condition);
    }
  }
  for (const Assertion& assertion : e.assertions) {
    if (const auto check = Check::parse(assertion.text, Check::Over::Condition, metrics); !check) {
      root.fail("assertions", assertion.text + ": " + check.error().message);
    }
    if (!assertion.condition.empty() && !isCondition(assertion.condition)) {
      root.fail("assertions", "there is no condition " + assertion.condition);
    }
  }
  const std::vector<MetricInfo> ofTeams = tournamentMetrics();
  for (const TeamAssertion& one :
       e.tournament ? e.tournament->assertions : std::vector<TeamAssertion>{}) {
    if (const auto check = Check::parse(one.text, Check::Over::Condition, ofTeams); !check) {
      root.fail("assertions", one.text + ": " + check.error().message);
    }
  }
  for (const std::size_t number : e.recorded) {
    if (number > e.allRuns()) {
      root.fail("record", "there are only " + std::to_string(e.allRuns()) + " runs");
    }
  }
}

void adviseTeams(Tournament& tournament, const std::vector<std::string>& names,
                 const JsonObject& root) {
  for (const std::string& name : names) {
    const auto team = std::ranges::find(tournament.teams, name, &TournamentTeam::name);
    if (team == tournament.teams.end()) {
      std::vector<std::string_view> known;
      for (const TournamentTeam& one : tournament.teams) known.push_back(one.name);
      return root.fail("teams", unknownName("team", name, known));
    }
    if (team->advisor.empty() || team->advisor == "false") team->advisor = "true";
  }
}

/// The rules as they stand in a file.
Json rulesJson(const std::vector<telemetry::Rule>& rules) {
  Json out = Json::array();
  for (const telemetry::Rule& rule : rules) {
    Json& one = out.emplace_back(Json{{"name", rule.name},
                                      {"text", rule.text},
                                      {"when", rule.question.condition},
                                      {"for", rule.question.least},
                                      {"severity", nameOf(rule.severity)}});
    if (!rule.question.robots.empty()) one["robots"] = rule.question.robots;
  }
  return out;
}

std::vector<ExperimentName> namesIn(std::string_view folder) {
  std::vector<ExperimentName> out;
  for (const std::string_view name : resourceNames(folder.substr(0, folder.size() - 1))) {
    const std::string path = std::string(folder) + std::string(name) + ".json";
    JsonReport report(path);
    const auto root = parseJson(resourceText(path), report);
    const JsonNode* title = root ? root->find("title") : nullptr;
    out.push_back({std::string(name), title ? title->text : std::string(name)});
  }
  return out;
}

}  // namespace

std::vector<ExperimentName> builtInExperiments() {
  return namesIn(experimentsFolder);
}

std::vector<ExperimentName> builtInSituations() {
  return namesIn(situationsFolder);
}

Result<Experiment> loadExperiment(const std::string& nameOrPath, const ExperimentChanges& changes) {
  for (const std::string_view folder : {experimentsFolder, situationsFolder}) {
    const std::string_view text = resourceText(std::string(folder) + nameOrPath + ".json");
    if (!text.empty()) return experimentFromJson(text, nameOrPath, {}, changes);
  }
  const auto text = readFile(nameOrPath, maxFileBytes, "the experiment");
  if (!text && text.error().code == ErrorCode::NotFound &&
      nameOrPath.find_first_of("/.") == std::string::npos) {
    const auto all = builtInExperiments();
    std::vector<std::string_view> known;
    for (const ExperimentName& one : all) known.push_back(one.name);
    return failure(ErrorCode::NotFound,
                   unknownName("built-in experiment and no file", nameOrPath, known));
  }
  if (!text) return tl::unexpected(text.error());
  return experimentFromJson(*text, nameOrPath,
                            std::filesystem::path(nameOrPath).parent_path().string(), changes);
}

Result<Experiment> experimentFromJson(std::string_view text, std::string_view source,
                                      const std::string& folder, const ExperimentChanges& changes) {
  JsonReport report(source);
  const auto root = parseJson(text, report);
  if (!root) return tl::unexpected(report.error());
  Experiment e;
  ConditionParts parts;
  ExperimentReader reader(*root, report, folder);
  reader.read(e, parts);
  const JsonObject object(report, *root, "");
  if (changes.seed) e.seed = *changes.seed;
  if (changes.runs) e.runs = *changes.runs;
  std::size_t matches = reader.matches();
  if (e.tournament && !report.failed()) {
    if (changes.runs) matches = *changes.runs * (e.tournament->swapSides ? 2 : 1);
    matches = changes.matches.value_or(matches);
    adviseTeams(*e.tournament, changes.advised, object);
  }
  if (e.tournament && !report.failed()) {
    addMatches(e, parts, matches, object, report);
  }
  makeWhole(e, parts, object, report);
  if (report.failed()) return tl::unexpected(report.error());
  if (e.tournament) playToTheWhistle(e, root->find("stop") != nullptr || parts.stop.duration);
  Json whole = jsonOf(*root);
  whole["scenario"] = parts.scenario;
  whole[e.tournament ? "matches" : "runs"] = e.tournament ? matches : e.runs;
  whole["seed"] = e.seed;
  if (!e.rules.empty()) whole["rules"] = rulesJson(e.rules);
  for (std::size_t i = 0; e.tournament && i < e.tournament->teams.size(); ++i) {
    const std::string& runtime = e.tournament->teams[i].runtime;
    if (!runtime.empty()) whole["teams"][i]["runtime"] = runtime;
    const std::string& advisor = e.tournament->teams[i].advisor;
    if (!advisor.empty()) whole["teams"][i]["advisor"] = Json::parse(advisor);
  }
  e.text = whole.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  return e;
}

bool makeWhole(Experiment& e, const ConditionParts& parts, const JsonObject& root,
               JsonReport& report) {
  if (!report.failed() && makeConditions(e, parts, report)) checkRandom(e, report);
  if (!report.failed()) findTeamPrograms(e, root);
  if (!report.failed()) checkWhole(e, root);
  return !report.failed();
}

bool isRecorded(const Experiment& experiment, std::size_t number, bool success) {
  switch (experiment.record) {
    case Record::Nothing:
      return false;
    case Record::Failed:
      return !success;
    case Record::All:
      return true;
    case Record::Chosen:
      break;
  }
  const auto& chosen = experiment.recorded;
  return std::ranges::find(chosen, number) != chosen.end();
}

RunPlace placeOf(const Experiment& experiment, std::size_t number) {
  return {number, (number - 1) / experiment.runs, (number - 1) % experiment.runs};
}

std::uint64_t seedOf(const Experiment& experiment, const RunPlace& run) {
  return experiment.seed + (experiment.commonSeeds ? run.index : run.number - 1);
}

Result<Scenario> scenarioOf(const Experiment& experiment, const RunPlace& run) {
  const Condition& condition = experiment.conditions[run.condition];
  const std::uint64_t seed = seedOf(experiment, run);
  Scenario scenario = condition.scenario;
  std::size_t draw = 0;
  if (!experiment.random.empty()) {
    Json patched = Json::parse(condition.json);
    for (const RandomSetting& setting : experiment.random) {
      const double value = drawn(seed, draw++, setting.from, setting.to);
      if (auto put = putValue(patched, setting.key, value); !put) {
        return failure(put.error().code, put.error().message, "random." + setting.key);
      }
    }
    auto made = scenarioFromJson(patched.dump(), "run " + std::to_string(run.number));
    if (!made) return failure(made.error().code, made.error().message, "random");
    scenario = std::move(*made);
  }
  scenario.stop = {experiment.stop.duration};
  scenario.settings.seed = seed;
  for (const StartSpread& start : experiment.starts) {
    const auto spread = [&](Point& place) {
      place.x += drawn(seed, draw++, -start.x, start.x);
      place.y += drawn(seed, draw++, -start.y, start.y);
    };
    if (start.who == "ball") spread(scenario.ball);
    for (ScenarioRobot& robot : scenario.robots) {
      if (start.who != "robots" && start.who != robot.identity.name()) continue;
      spread(robot.pose.position);
      robot.pose.yaw = wrapToPi(
          robot.pose.yaw + radiansFromDegrees(drawn(seed, draw++, -start.heading, start.heading)));
    }
  }
  return scenario;
}

}  // namespace pitchboard::link
