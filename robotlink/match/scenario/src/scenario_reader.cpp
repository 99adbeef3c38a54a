// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include <base/angles.h>
#include <base/byte_sizes.h>
#include <base/read_file.h>
#include <base/short_name.h>
#include <resources/resources.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/models/robot_models.h>
#include <simcore/world/field_text.h>
#include <simcore/world/limits.h>

#include "game_json.h"
#include "referee_rules_json.h"
#include "scenario_keys.h"

namespace pitchboard::link {
namespace {

constexpr double maxTime = 1e6;   // s
constexpr double maxClock = 1e6;  // s
constexpr int maxGoals = 1'000'000;
constexpr std::size_t maxWrites = 100000;
constexpr std::size_t maxRuntimeLength = 4096;
constexpr std::size_t maxTeamNameLength = 64;
constexpr std::size_t maxFileBytes = 32 * mebibyte;  // maxWrites of them, indented

/// The default first, as in choosers.
const std::vector<std::string_view>& builtInNames() {
  static const auto all =
      resourceNames("scenarios", {"match", "kick-off", "match-3v3", "published-match-3v3",
                                  "scenario-1", "scenario-2", "one-robot", "match-11v11", "empty"});
  return all;
}

std::string resourcePath(std::string_view name) {
  return "scenarios/" + std::string(name) + ".json";
}

/// How long a match lasts is one of several reasons to end it, which people write beside them.
const JsonNode& withoutDuration(const JsonNode& root, JsonReport& report) {
  if (const JsonNode* duration = root.find("duration"))
    report.fail(duration->line, "duration", R"(stands in "stop": write "stop": {"duration": 60})");
  return root;
}

class Reader {
 public:
  Reader(const JsonNode& root, JsonReport& report, const VariableCatalog& catalog)
      : m_report(report),
        m_catalog(catalog),
        m_root(report, withoutDuration(root, report), "",
               {"version", "name",        "title",         "description", "physics", "tick_rate",
                "seed",    "after_goal",  "clock_running", "clock",       "score",   "field",
                "noise",   "robot_model", "rigid_body",    "ball",        "robots",  "writes",
                "stop",    "referee",     "runtime",       "teams",       "game"}) {}

  Scenario read() {
    readVersion();
    m_scenario.name = readShortName(m_root, "name", m_scenario.name);
    m_scenario.title = m_root.text("title", "", 200);
    m_scenario.description = m_root.text("description", "", 5000);
    readSettings();
    readField();
    readNoise();
    readRobotModel();
    readRigidBody();
    m_scenario.settings.referee = readReferee(m_report, m_root, "referee");
    readTeams();
    readBall();
    m_scenario.clockRunning = m_root.boolean("clock_running", true);
    m_scenario.clock = m_root.number("clock", 0.0, {0, maxClock, "seconds"});
    readScore();
    readRuntimes();
    readRobots();
    m_scenario.game = readGameStart(m_report, m_root, m_robots, m_scenario);
    readWrites();
    readStop();
    std::ranges::stable_sort(m_scenario.writes,
                             [](const auto& a, const auto& b) { return a.time < b.time; });
    return std::move(m_scenario);
  }

 private:
  void readVersion() {
    m_root.require("version");
    const int version = m_root.integer("version", scenarioVersion, 1, 1000000);
    if (version != scenarioVersion) {
      m_root.fail("version", "is " + std::to_string(version) + ", but this program reads version " +
                                 std::to_string(scenarioVersion) + "; a newer program wrote this");
    }
  }

  void readSettings() {
    sim::SimulationSettings& settings = m_scenario.settings;
    std::vector<std::string_view> models;
    for (const auto& model : sim::physicsModels()) models.push_back(model.name);
    if (const auto model = m_root.choice("physics", models, "physics model")) {
      settings.physics = models[*model];
    }
    settings.tickRate = m_root.number(sim::tickRateParameter.key, settings.tickRate,
                                      sim::rangeOf(sim::tickRateParameter));
    settings.seed = m_root.unsignedInteger("seed", settings.seed);
    if (const auto rule = m_root.choice("after_goal", afterGoalNames, "rule after a goal")) {
      settings.afterGoal = static_cast<sim::AfterGoal>(*rule);
    }
  }

  void readField() {
    const JsonNode* node = m_root.find("field");
    if (!node) return;
    const std::vector<std::string_view> known = sim::fieldNames();
    sim::FieldSpec& field = m_scenario.settings.field;
    if (node->kind == JsonNode::Kind::Text) {
      if (const auto built = m_root.choice("field", known, "field")) {
        field = sim::builtInFields()[*built];
      }
      return;
    }
    if (node->kind != JsonNode::Kind::Object) {
      m_root.fail("field", "must be the name of a field, in quotes, or an object in braces");
      return;
    }
    field = sim::readField(m_report, *node, "field");
  }

  void readNoise() {
    if (const auto noise = link::readNoise(m_root, m_report, "noise")) {
      m_scenario.settings.noise = *noise;
    }
  }

  void readRobotModel() {
    if (const auto model = link::readRobotModel(m_root, m_report, "robot_model")) {
      m_defaultModel = *model;
    }
  }

  void readRigidBody() {
    sim::RigidBodySettings& body = m_scenario.settings.rigidBody;
    body.ballMass = m_scenario.settings.field.ballMass;
    const JsonNode* node = m_root.find("rigid_body");
    if (!node) return;
    std::vector<std::string_view> keys =
        sim::withKeys({sim::fallsSwitch.key}, sim::rigidBodyParameters);
    for (const EarlierKey& earlier : earlierKeys) keys.push_back(earlier.key);
    const JsonObject object(m_report, *node, "rigid_body", keys);
    body.falls = object.boolean(sim::fallsSwitch.key, body.falls);
    sim::readNumbers(object, sim::rigidBodyParameters, body);
    if (readEarlier(object, sim::robotModelParameters, m_defaultModel)) {
      m_defaultModel.name = "custom";
    }
    // Until version 0.8 every field had the published surface, and these keys changed it.
    sim::Surface surface;
    if (readEarlier(object, sim::surfaceParameters, surface)) {
      m_scenario.settings.field.surface = surface;
    }
  }

  /// Whether the object has any of these keys.
  static bool readEarlier(const JsonObject& object, const auto& parameters, auto& values) {
    bool any = false;
    for (const EarlierKey& earlier : earlierKeys) {
      for (const auto& parameter : parameters) {
        if (parameter.key != earlier.now || !object.find(earlier.key)) continue;
        values.*parameter.member =
            parameter.stored(object.number(earlier.key, 0.0, sim::rangeOf(parameter)));
        any = true;
      }
    }
    return any;
  }

  void readBall() {
    const JsonNode* node = m_root.find("ball");
    if (!node) return;
    const JsonObject ball(m_report, *node, "ball", {"x", "y", "vx", "vy"});
    m_scenario.ball = readPlace(ball);
    const NumberRange speed{-sim::fastestBall, sim::fastestBall, "metres per second"};
    m_scenario.ballVelocity = {ball.number("vx", 0.0, speed), ball.number("vy", 0.0, speed)};
  }

  void readScore() {
    const JsonNode* node = m_root.find("score");
    if (!node) return;
    const JsonObject score(m_report, *node, "score", {"left", "right"});
    m_scenario.score = {score.integer("left", 0, 0, maxGoals),
                        score.integer("right", 0, 0, maxGoals)};
  }

  /// Inside the walls.
  Point readPlace(const JsonObject& object) const {
    const sim::FieldSpec& field = m_scenario.settings.field;
    const double x = field.halfLength() + field.border;
    const double y = field.halfWidth() + field.border;
    return {object.number("x", 0.0, {-x, x, sim::units::metres.name}),
            object.number("y", 0.0, {-y, y, sim::units::metres.name})};
  }

  void readRobots() {
    const auto* items = m_root.array("robots", sim::Simulation::maxRobots);
    for (std::size_t i = 0; items && i < items->size(); ++i) {
      readRobot((*items)[i], i);
    }
  }

  void readRuntimes() {
    const JsonNode* node = m_root.find("runtime");
    if (!node || m_report.failed()) return;
    std::vector<std::string_view> teams;
    for (const TeamColorInfo& color : teamColors) teams.push_back(color.name);
    const JsonObject object(m_report, *node, "runtime", teams);
    if (m_report.failed()) return;
    for (const TeamColorInfo& color : teamColors) {
      if (object.find(color.name)) {
        m_scenario.runtimes[color.color] = readRuntime(object, color.name);
      }
    }
  }

  static RuntimeChoice readRuntime(const JsonObject& object, std::string_view key) {
    if (!object.find(key)) return {};
    const std::string text = object.text(key, "", maxRuntimeLength);
    const auto choice = runtimeChoiceFromText(text);
    if (!choice) {
      object.fail(key, choice.error().message);
      return {};
    }
    // A file is read when the match is played, where the scenario is played.
    if (choice->profile.find_first_of("/.") == std::string::npos) {
      if (const auto profile = loadRuntime(*choice); !profile) {
        object.fail(key, profile.error().text());
      }
    }
    return *choice;
  }

  void readTeams() {
    std::vector<std::string_view> colours;
    for (const TeamColorInfo& color : teamColors) colours.push_back(color.name);
    const auto* items = m_root.array("teams", 2);
    for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
      const JsonObject object(m_report, (*items)[i], m_root.pathOf("teams", i),
                              {"colour", "number", "name", "advisor"});
      object.require("colour");
      const std::size_t colour = object.choice("colour", colours, "colour of a team").value_or(0);
      const sim::TeamSettings team{teamColors[colour].color, object.integer("number", 0, 0, 255),
                                   object.text("name", "", maxTeamNameLength)};
      for (const sim::TeamSettings& other : m_scenario.settings.teams) {
        if (other.colour == team.colour) object.fail("colour", "is also used by the other team");
        if (team.number != 0 && other.number == team.number) {
          object.fail("number", "is also used by the other team");
        }
      }
      m_scenario.settings.teams.push_back(team);
      readAdvisor(object, team.colour);
    }
  }

  /// true, false, or an object with options. Those that versions up to 0.22 had besides `memory`
  /// are ignored.
  void readAdvisor(const JsonObject& team, TeamColor colour) {
    const JsonNode* node = team.find("advisor");
    if (!node) return;
    AdvisorOptions options;
    if (node->kind == JsonNode::Kind::Object) {
      const JsonObject object(m_report, *node, team.pathOf("advisor"),
                              {"rollouts", "horizon", "learns", "memory"});
      options.memory = object.text("memory", options.memory, 4096);
    } else if (!team.boolean("advisor", false)) {
      return;
    }
    m_scenario.advisors[colour] = options;
  }

  void readRobot(const JsonNode& node, std::size_t index) {
    const std::string path = "robots[" + std::to_string(index) + "]";
    const std::size_t before = m_report.errors();
    const JsonObject object(
        m_report, node, path,
        {"team", "number", "x", "y", "heading", "behaviour", "id", "imu_starts_at_180",
         "blackboard", "runtime", "model", "belief", "penalty", "cards", "goalkeeper"});
    m_robots.push_back(object);
    for (const std::string_view key : {"team", "number", "x", "y"}) object.require(key);
    std::vector<std::string_view> teams;
    for (const TeamColorInfo& color : teamColors) teams.push_back(color.name);
    const std::size_t team = object.choice("team", teams, "team").value_or(0);
    const bool facesLeft = teamColors[team].facesLeft;

    ScenarioRobot robot;
    robot.identity.team = teamColors[team].color;
    robot.identity.number = object.integer("number", 1, 1, sim::highestShirtNumber);
    robot.identity.id.value =
        object.integer("id", static_cast<int>(index) + 1, 1, sim::Simulation::maxRobots);
    robot.identity.imuStartsAt180 = object.boolean("imu_starts_at_180", facesLeft);
    robot.pose.position = readPlace(object);
    robot.pose.yaw = radiansFromDegrees(
        object.number("heading", facesLeft ? 180.0 : 0.0, {-360, 360, sim::units::degrees.name}));
    std::vector<std::string_view> known;
    for (const BehaviourInfo& behaviour : behaviours()) known.push_back(behaviour.name);
    known.push_back(noBehaviour);
    if (object.find("behaviour")) {
      BehaviourChoice choice = readBehaviour(object, m_report, "behaviour", known);
      robot.behaviour = std::move(choice.name);
      robot.parameters = choice.parameters;
    }
    robot.runtime = readRuntime(object, "runtime");
    readBelief(object, robot);
    // What is not known cannot be compared.
    const bool read = m_report.errors() == before;
    if (!read) robot.identity.number = 0;
    for (std::size_t other = 0; read && other < m_scenario.robots.size(); ++other) {
      const sim::RobotIdentity& taken = m_scenario.robots[other].identity;
      const std::string where = "robots[" + std::to_string(other) + "]";
      if (taken.id == robot.identity.id) {
        object.fail("id", "robot " + std::to_string(taken.id.value) + " is already " + where);
      }
      if (taken.team == robot.identity.team && taken.number == robot.identity.number) {
        object.fail("number", std::string(teams[team]) + " already has a robot with number " +
                                  std::to_string(taken.number) + ": " + where);
      }
    }
    readBlackboard(object, robot.identity.id);
    robot.model = link::readRobotModel(object, m_report, "model").value_or(m_defaultModel);
    m_scenario.robots.push_back(std::move(robot));
  }

  void readBelief(const JsonObject& object, ScenarioRobot& robot) const {
    const JsonNode* node = object.find("belief");
    if (!node) return;
    const JsonObject belief(m_report, *node, object.pathOf("belief"),
                            {"x", "y", "heading", "sigma"});
    for (const std::string_view key : {"x", "y", "heading"}) belief.require(key);
    ScenarioBelief& out = robot.belief.emplace();
    out.pose.position = readPlace(belief);
    out.pose.yaw =
        radiansFromDegrees(belief.number("heading", 0.0, {-360, 360, sim::units::degrees.name}));
    out.sigma = belief.number("sigma", 0.0, {0, 10, sim::units::metres.name});
  }

  void readBlackboard(const JsonObject& robot, RobotId id) {
    const JsonNode* node = robot.find("blackboard");
    if (!node) return;
    std::vector<std::string_view> names;
    for (const auto& [name, value] : node->members) names.push_back(name);
    const JsonObject object(m_report, *node, robot.pathOf("blackboard"), names);
    for (const std::string_view name : names) {
      if (const Variable* variable = findVariable(object, name, name)) {
        const double value = readValue(object, name, *variable);
        m_scenario.writes.push_back({id, std::string(name), value, 0.0});
      }
    }
  }

  void readWrites() {
    const auto* items = m_root.array("writes", maxWrites);
    for (std::size_t i = 0; items && i < items->size(); ++i) {
      const std::size_t before = m_report.errors();
      const JsonObject object(m_report, (*items)[i], "writes[" + std::to_string(i) + "]",
                              {"time", "robot", "variable", "value"});
      for (const std::string_view key : {"variable", "value"}) object.require(key);
      BlackboardWrite write;
      write.time = object.number("time", 0.0, {0, maxTime, "seconds"});
      if (object.find("robot")) {
        write.robot.value = object.integer("robot", 1, 1, sim::Simulation::maxRobots);
        const auto& robots = m_scenario.robots;
        if (std::ranges::none_of(
                robots, [&](const ScenarioRobot& r) { return r.identity.id == write.robot; })) {
          object.fail("robot", "there is no robot " + std::to_string(write.robot.value) +
                                   " in this scenario; leave it out to mean every robot");
        }
      }
      write.variable = object.text("variable", "", 200);
      if (m_report.errors() != before) continue;
      if (const Variable* variable = findVariable(object, "variable", write.variable)) {
        write.value = readValue(object, "value", *variable);
      }
      m_scenario.writes.push_back(std::move(write));
    }
  }

  const Variable* findVariable(const JsonObject& object, std::string_view key,
                               std::string_view name) const {
    if (const Variable* variable = m_catalog.find(name)) return variable;
    std::vector<std::string_view> known;
    for (const Variable& variable : m_catalog.variables()) known.push_back(variable.name);
    object.fail(key, unknownName("blackboard variable", name, known));
    return nullptr;
  }

  /// Which number the text stands for, if the variable's values are codes with labels.
  static std::string codeHint(const std::string& variable, const std::string& text) {
    telemetry::ColumnInfo column;
    column.name = variable;
    VariableMeanings::published().describe(column);
    std::vector<std::string_view> labels;
    for (const auto& [code, label] : column.labels) {
      if (label == text) return "; write " + std::to_string(code) + " for \"" + text + '"';
      labels.emplace_back(label);
    }
    return labels.empty() ? std::string() : "; " + unknownName("code", text, labels);
  }

  static double readValue(const JsonObject& object, std::string_view key,
                          const Variable& variable) {
    if (const JsonNode* value = object.find(key);
        value != nullptr && value->kind == JsonNode::Kind::Text) {
      object.fail(key, "must be a number" + codeHint(variable.name, value->text));
      return 0.0;
    }
    if (variable.type == VariableType::Int) {
      return object.integer(key, 0, std::numeric_limits<std::int32_t>::min(),
                            std::numeric_limits<std::int32_t>::max());
    }
    constexpr double most = std::numeric_limits<float>::max();
    return object.number(key, 0.0, {-most, most});
  }

  void readStop() {
    const JsonNode* node = m_root.find("stop");
    if (!node) return;
    const JsonObject object(m_report, *node, "stop", {"duration", "goal", "ball_out"});
    if (object.find("duration")) {
      m_scenario.stop.duration = object.number("duration", 0.0, {0.001, maxTime, "seconds"});
    }
    m_scenario.stop.goal = object.boolean("goal", false);
    m_scenario.stop.ballOut = object.boolean("ball_out", false);
  }

  JsonReport& m_report;
  const VariableCatalog& m_catalog;
  JsonObject m_root;
  sim::RobotModel m_defaultModel;  // of robots that name none
  std::vector<JsonObject> m_robots;
  Scenario m_scenario;
};

}  // namespace

std::vector<ScenarioName> builtInScenarios() {
  std::vector<ScenarioName> all;
  for (const std::string_view name : builtInNames()) {
    const auto scenario = scenarioFromJson(resourceText(resourcePath(name)), name);
    all.push_back({std::string(name), scenario ? scenario->title : std::string(name)});
  }
  return all;
}

Result<Scenario> loadScenario(const std::string& nameOrPath, const VariableCatalog& catalog) {
  if (std::ranges::find(builtInNames(), nameOrPath) != builtInNames().end()) {
    return scenarioFromJson(resourceText(resourcePath(nameOrPath)), nameOrPath, catalog);
  }
  auto text = readFile(nameOrPath, maxFileBytes, "the scenario");
  if (!text && text.error().code == ErrorCode::NotFound &&
      nameOrPath.find_first_of("/.") == std::string::npos) {
    return failure(ErrorCode::NotFound,
                   unknownName("built-in scenario and no file", nameOrPath, builtInNames()));
  }
  if (!text) return tl::unexpected(text.error());
  return scenarioFromJson(*text, nameOrPath, catalog);
}

Result<Scenario> scenarioFromJson(std::string_view text, std::string_view source,
                                  const VariableCatalog& catalog) {
  JsonReport report(source);
  const auto root = parseJson(text, report, maxFileBytes);
  if (report.failed()) return tl::unexpected(report.allErrors());
  Scenario scenario = Reader(*root, report, catalog).read();
  if (report.failed()) return tl::unexpected(report.allErrors());
  return scenario;
}

}  // namespace pitchboard::link
