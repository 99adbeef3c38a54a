// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/capi/world_lines.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <type_traits>

#include <base/lined_json.h>

#include "world_columns.h"

namespace pitchboard::link {

using Json = nlohmann::ordered_json;

/// One line: reads what it asks for, does it, and fills the answer.
class WorldRequest {
 public:
  WorldRequest(WorldLines& lines, const JsonNode& node, JsonReport& report, Json& answer)
      : m_lines(lines),
        m_node(node),
        m_report(report),
        m_answer(answer),
        m_request(report, node, "") {}

  void carryOut();

  struct Verb {
    std::string_view name;
    void (WorldRequest::*carryOut)();
    std::vector<std::string_view> keys;
  };
  static const std::vector<Verb>& verbs();

 private:
  void create();
  void columns();
  void behaviour();
  void reset();
  void step();
  void read();
  void write();
  void placeRobot();
  void placeBall();
  void snapshot();
  void restore();
  void forget();
  void hashes();

  bool failed() const { return m_report.failed(); }
  void fail(const Error& error) { m_report.fail(1, "", error.text(), error.code); }
  void fail(std::string_view key, const std::string& text) { m_request.fail(key, text); }
  bool check(const Result<void>& done) {
    if (!done) fail(done.error());
    return done.has_value();
  }
  /// Null, and an error, before `create`.
  Worlds* worlds();
  int world(int fallback);
  RobotId robot() const;
  double number(std::string_view key) const;
  std::optional<std::vector<Variable>> variables();
  /// The numbers of nested lists of this shape; `absent` stands for null.
  template <class Value>
  std::optional<std::vector<Value>> values(std::string_view key, std::span<const std::size_t> shape,
                                           Value absent);
  template <class Value>
  void flatten(const JsonNode& node, const std::string& path, std::span<const std::size_t> shape,
               Value absent, std::vector<Value>& out);
  bool answerable(std::size_t size);
  template <class Value>
  static Json nested(std::span<const Value> values, std::span<const std::size_t> shape);

  WorldLines& m_lines;
  const JsonNode& m_node;
  JsonReport& m_report;
  Json& m_answer;
  JsonObject m_request;
};

const std::vector<WorldRequest::Verb>& WorldRequest::verbs() {
  static const std::vector<Verb> list{
      {"create",
       &WorldRequest::create,
       {"scenario", "text", "worlds", "threads", "seed", "duration", "noise", "physics",
        "particles"}},
      {"columns", &WorldRequest::columns, {}},
      {"behaviour", &WorldRequest::behaviour, {"robot", "behaviour"}},
      {"reset", &WorldRequest::reset, {"world", "seed"}},
      {"step", &WorldRequest::step, {"ticks"}},
      {"read", &WorldRequest::read, {"what", "variables"}},
      {"write", &WorldRequest::write, {"variables", "values", "actions", "commands"}},
      {"place_robot", &WorldRequest::placeRobot, {"world", "robot", "x", "y", "yaw"}},
      {"place_ball", &WorldRequest::placeBall, {"world", "x", "y", "velocity_x", "velocity_y"}},
      {"snapshot", &WorldRequest::snapshot, {"world"}},
      {"restore", &WorldRequest::restore, {"world", "snapshot"}},
      {"forget", &WorldRequest::forget, {"snapshot"}},
      {"hashes", &WorldRequest::hashes, {}},
  };
  return list;
}

void WorldRequest::carryOut() {
  if (failed()) return;
  m_request.require("do");
  const auto chosen = m_request.choice("do", WorldLines::requests(), "request");
  if (!chosen) return;
  const Verb& verb = verbs()[*chosen];
  std::vector<std::string_view> keys = verb.keys;
  keys.insert(keys.end(), {"do", "id"});
  m_request = JsonObject(m_report, m_node, "", keys);
  if (!failed()) (this->*verb.carryOut)();
}

Worlds* WorldRequest::worlds() {
  if (m_lines.m_worlds) return &*m_lines.m_worlds;
  fail("do", "there are no worlds yet; send {\"do\": \"create\"} before");
  return nullptr;
}

int WorldRequest::world(int fallback) {
  return m_request.integer("world", fallback, 0, Worlds::maxWorlds);
}

RobotId WorldRequest::robot() const {
  m_request.require("robot");
  return {m_request.integer("robot", 0, 1, highestRobotNumber)};
}

double WorldRequest::number(std::string_view key) const {
  return m_request.number(key, 0.0, anyNumber);
}

void WorldRequest::create() {
  const WorldLineLimits& limits = m_lines.m_limits;
  Scenario scenario = m_lines.m_usual;
  const std::string name = m_request.text("scenario", "", 4096);
  const std::string text = m_request.text("text", "", WorldLines::maxLineLength);
  ScenarioOverrides overrides;
  overrides.noise = m_request.text("noise", "", 100);
  overrides.physics = m_request.text("physics", "", 100);
  overrides.duration = m_request.number("duration", 0.0, {0.0, 1e9, "seconds"});
  WorldsOptions options;
  options.count = m_request.integer("worlds", 1, 1, limits.worlds);
  options.threads = m_request.integer("threads", 1, 1, Worlds::maxThreads);
  if (m_request.find("seed")) options.seed = m_request.unsignedInteger("seed", 1);
  if (m_request.find("particles")) {
    options.particles = m_request.integer("particles", 500, 1, 100000);
  }
  if (failed()) return;
  if (!name.empty() && !text.empty()) return fail("text", "a scenario has a name or a text");
  if (!name.empty() || !text.empty()) {
    const auto known = builtInScenarios();
    if (!limits.files && !name.empty() &&
        std::ranges::none_of(known, [&](const auto& s) { return s.name == name; })) {
      return fail("scenario", "is not built in");
    }
    auto loaded = text.empty() ? loadScenario(name) : scenarioFromJson(text, "text");
    if (!loaded) return fail(loaded.error());
    scenario = std::move(*loaded);
  }
  const auto wanted = changed(std::move(scenario), overrides);
  if (!wanted) return fail(wanted.error());
  auto made = Worlds::create(*wanted, options);
  if (!made) return fail(made.error());
  m_lines.m_worlds = std::move(*made);
  m_lines.m_snapshots.clear();
  m_answer["worlds"] = m_lines.m_worlds->count();
  Json ids = Json::array();
  for (const RobotId id : m_lines.m_worlds->robotIds()) ids.push_back(id.value);
  m_answer["robots"] = std::move(ids);
  m_answer["tick_rate"] = m_lines.m_worlds->tickRate();
}

void WorldRequest::columns() {
  const auto list = [this](const char* key, std::span<const WorldColumn> columns) {
    Json names = Json::array();
    for (const WorldColumn& column : columns) {
      names.push_back({{"name", column.name}, {"words", column.description}});
    }
    m_answer[key] = std::move(names);
  };
  list("percepts", columnsOf(WorldArray::Percepts));
  list("robots", columnsOf(WorldArray::Robots));
  list("game", columnsOf(WorldArray::Game));
  list("commands", commandColumns());
}

void WorldRequest::behaviour() {
  Worlds* const all = worlds();
  const RobotId id = robot();
  m_request.require("behaviour");
  const std::string name = m_request.text("behaviour", "", 100);
  if (!failed()) check(all->setBehaviour(id, name));
}

void WorldRequest::reset() {
  Worlds* const all = worlds();
  m_request.require("seed");
  const std::uint64_t seed = m_request.unsignedInteger("seed", 1);
  const int one = world(Worlds::all);
  if (!failed()) check(all->reset(one, seed));
}

void WorldRequest::step() {
  Worlds* const all = worlds();
  if (!all) return;
  const auto count = static_cast<int>(all->count());
  const int ticks = m_request.integer("ticks", 1, 1, std::max(1, m_lines.m_limits.ticks / count));
  if (failed() || !check(all->step(ticks))) return;
  Json reasons = Json::array();
  for (std::size_t i = 0; i < all->count(); ++i) reasons.push_back(all->finishedBy(i));
  m_answer["finished"] = std::move(reasons);
}

bool WorldRequest::answerable(std::size_t size) {
  if (size <= m_lines.m_limits.values) return true;
  fail("do", "would read " + std::to_string(size) + " values, more than the " +
                 std::to_string(m_lines.m_limits.values) + " of one answer; make fewer worlds");
  return false;
}

template <class Value>
Json WorldRequest::nested(std::span<const Value> values, std::span<const std::size_t> shape) {
  Json list = Json::array();
  const std::size_t part = shape[0] == 0 ? 0 : values.size() / shape[0];
  for (std::size_t i = 0; i < shape[0]; ++i) {
    if (shape.size() == 1) {
      list.push_back(values[i]);  // not a number becomes null
    } else {
      list.push_back(nested(values.subspan(i * part, part), shape.subspan(1)));
    }
  }
  return list;
}

void WorldRequest::read() {
  Worlds* const all = worlds();
  if (!all) return;
  constexpr std::array<std::string_view, 4> names{"percepts", "robots", "game", "boards"};
  const auto what = m_request.choice("what", names, "array");
  const std::size_t rows = all->count() * all->robots();
  if (failed()) return;
  if (what.has_value() == (m_request.find("variables") != nullptr)) {
    return fail("do", "read needs \"what\" or \"variables\"");
  }
  if (!what) {
    const auto wanted = variables();
    if (!wanted || !answerable(rows * wanted->size())) return;
    std::vector<double> out(rows * wanted->size());
    const std::array shape{all->count(), all->robots(), wanted->size()};
    if (check(all->readVariables(*wanted, out))) {
      m_answer["values"] = nested<double>(out, shape);
    }
    return;
  }
  if (names[*what] == "boards") {
    const std::array shape{all->count(), all->robots(), std::size_t{Blackboard::words}};
    if (!answerable(rows * Blackboard::words)) return;
    std::vector<std::uint32_t> out(rows * Blackboard::words);
    if (check(all->readBoards(out))) m_answer["values"] = nested<std::uint32_t>(out, shape);
    return;
  }
  const auto array = static_cast<WorldArray>(*what);
  if (!answerable(all->sizeOf(array))) return;
  std::vector<double> out(all->sizeOf(array));
  if (!check(all->read(array, out))) return;
  std::vector<std::size_t> shape{all->count(), all->robots(), columnsOf(array).size()};
  if (array == WorldArray::Game) shape.erase(shape.begin() + 1);
  m_answer["values"] = nested<double>(out, shape);
}

std::optional<std::vector<Variable>> WorldRequest::variables() {
  const auto* list = m_request.array("variables", std::size_t{2} * Blackboard::words);
  if (!list) return {};
  std::vector<Variable> found;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto variable = worldVariable((*list)[i].text);
    if (!variable) {
      m_report.fail(1, m_request.pathOf("variables", i), variable.error().message);
      return {};
    }
    found.push_back(*variable);
  }
  if (!found.empty()) return found;
  fail("variables", "must have at least one name");
  return {};
}

template <class Value>
void WorldRequest::flatten(const JsonNode& node, const std::string& path,
                           std::span<const std::size_t> shape, Value absent,
                           std::vector<Value>& out) {
  if (failed()) return;
  if (shape.empty()) {
    if (node.kind == JsonNode::Kind::Null) return out.push_back(absent);
    if (node.kind != JsonNode::Kind::Number) {
      return m_report.fail(1, path, "must be a number, or null to keep the current value");
    }
    if constexpr (std::is_integral_v<Value>) {
      if (!(node.number > static_cast<double>(absent) && node.number <= 2147483647.0 &&
            node.number == std::floor(node.number))) {
        return m_report.fail(1, path, "must be a 32-bit integer");
      }
    }
    return out.push_back(static_cast<Value>(node.number));
  }
  if (node.kind != JsonNode::Kind::Array || node.items.size() != shape[0]) {
    return m_report.fail(1, path, "must be a list of " + std::to_string(shape[0]));
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    flatten(node.items[i], path + '[' + std::to_string(i) + ']', shape.subspan(1), absent, out);
  }
}

template <class Value>
std::optional<std::vector<Value>> WorldRequest::values(std::string_view key,
                                                       std::span<const std::size_t> shape,
                                                       Value absent) {
  m_request.require(key);
  if (failed()) return {};
  std::vector<Value> out;
  flatten(*m_request.find(key), m_request.pathOf(key), shape, absent, out);
  if (failed()) return {};
  return out;
}

void WorldRequest::write() {
  Worlds* const all = worlds();
  if (!all) return;
  const auto asked = [this](const char* key) { return m_request.find(key) != nullptr; };
  if (asked("variables") + asked("actions") + asked("commands") != 1) {
    return fail("do",
                "write needs one of \"variables\" (with \"values\"), \"actions\", \"commands\"");
  }
  if (asked("actions")) {
    const std::array shape{all->count(), all->robots()};
    const auto actions = values<std::int32_t>("actions", shape, Worlds::keep);
    if (actions) check(all->writeActions(*actions));
  } else if (asked("commands")) {
    const std::array shape{all->count(), all->robots(), commandColumns().size()};
    const auto commands = values<std::int32_t>("commands", shape, Worlds::keep);
    if (commands) check(all->writeCommands(*commands));
  } else {
    const auto wanted = variables();
    if (!wanted) return;
    const std::array shape{all->count(), all->robots(), wanted->size()};
    const auto numbers = values<double>("values", shape, std::numeric_limits<double>::quiet_NaN());
    if (numbers) check(all->writeVariables(*wanted, *numbers));
  }
}

void WorldRequest::placeRobot() {
  Worlds* const all = worlds();
  const RobotId id = robot();
  const int one = world(Worlds::all);
  for (const char* key : {"x", "y", "yaw"}) m_request.require(key);
  const Pose pose{{number("x"), number("y")}, number("yaw")};
  if (!failed()) check(all->placeRobot(one, id, pose));
}

void WorldRequest::placeBall() {
  Worlds* const all = worlds();
  const int one = world(Worlds::all);
  for (const char* key : {"x", "y"}) m_request.require(key);
  const Point place{number("x"), number("y")};
  const Velocity velocity{number("velocity_x"), number("velocity_y")};
  if (!failed()) check(all->placeBall(one, place, velocity));
}

void WorldRequest::snapshot() {
  Worlds* const all = worlds();
  const int one = world(0);
  if (failed()) return;
  if (m_lines.m_snapshots.size() >= m_lines.m_limits.snapshots) {
    return fail("do", "there are " + std::to_string(m_lines.m_snapshots.size()) +
                          " snapshots already; forget one");
  }
  auto taken = all->snapshot(one);
  if (!taken) return fail(taken.error());
  m_lines.m_snapshots.emplace(++m_lines.m_lastSnapshot, std::move(*taken));
  m_answer["snapshot"] = m_lines.m_lastSnapshot;
}

void WorldRequest::restore() {
  Worlds* const all = worlds();
  m_request.require("snapshot");
  const int number = m_request.integer("snapshot", 0, 1, std::numeric_limits<int>::max());
  const int one = world(Worlds::all);
  if (failed()) return;
  const auto found = m_lines.m_snapshots.find(number);
  if (found == m_lines.m_snapshots.end()) {
    return fail("snapshot", "there is no snapshot " + std::to_string(number));
  }
  check(all->restore(one, found->second));
}

void WorldRequest::forget() {
  m_request.require("snapshot");
  const int number = m_request.integer("snapshot", 0, 1, std::numeric_limits<int>::max());
  if (!failed() && m_lines.m_snapshots.erase(number) == 0) {
    fail("snapshot", "there is no snapshot " + std::to_string(number));
  }
}

void WorldRequest::hashes() {
  Worlds* const all = worlds();
  if (!all) return;
  std::vector<std::uint64_t> values(all->count());
  if (!check(all->readHashes(values))) return;
  Json list = Json::array();
  for (const std::uint64_t hash : values) {
    char text[24];
    std::snprintf(text, sizeof text, "0x%016" PRIx64, hash);
    list.push_back(text);
  }
  m_answer["hashes"] = std::move(list);
}

WorldLines::WorldLines(Scenario usual, const Limits& limits)
    : m_usual(std::move(usual)), m_limits(limits) {}

std::vector<std::string_view> WorldLines::requests() {
  std::vector<std::string_view> names;
  for (const WorldRequest::Verb& verb : WorldRequest::verbs()) names.push_back(verb.name);
  return names;
}

std::string WorldLines::answer(std::string_view line) {
  JsonReport report("line");
  Json answer{{"ok", true}};
  Json id;
  if (const auto node = parseJson(line, report, maxLineLength)) {
    if (const JsonNode* asked = node->find("id")) {
      if (asked->kind == JsonNode::Kind::Number) id = asked->number;
      if (asked->whole) id = *asked->whole;
      if (asked->kind == JsonNode::Kind::Text) id = asked->text;
    }
    WorldRequest(*this, *node, report, answer).carryOut();
  }
  if (report.failed()) answer = {{"ok", false}, {"error", report.error().message}};
  if (!id.is_null()) answer["id"] = std::move(id);
  return answer.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pitchboard::link
