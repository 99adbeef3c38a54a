// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario_patch.h"

#include <algorithm>
#include <charconv>
#include <span>
#include <vector>

#include <base/team_color.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t deepest = 8;

struct Step {
  std::string name;
  bool inBrackets = false;
};

tl::unexpected<Error> wrongKey(std::string sentence) {
  return failure(ErrorCode::InvalidArgument, std::move(sentence));
}

Result<std::vector<Step>> stepsOf(std::string_view key) {
  std::vector<Step> steps;
  std::size_t at = 0;
  while (at < key.size()) {
    const bool bracket = key[at] == '[';
    if (bracket || (key[at] == '.' && !steps.empty())) ++at;
    const std::size_t end = bracket ? key.find(']', at) : key.find_first_of(".[", at);
    if (bracket && end == std::string_view::npos) return wrongKey("its '[' is not closed");
    std::string name(key.substr(at, end == std::string_view::npos ? end : end - at));
    if (name.empty()) return wrongKey("a part of it is empty");
    steps.push_back({std::move(name), bracket});
    at = end == std::string_view::npos ? key.size() : end + (bracket ? 1 : 0);
  }
  if (steps.empty() || steps.front().inBrackets) {
    return wrongKey("it must begin with a key of a scenario, such as noise");
  }
  if (steps.size() > deepest) return wrongKey("it has more than eight parts");
  return steps;
}

/// "B1": the letter of the team, the number on the shirt.
bool isRobot(const Json& robot, std::string_view name) {
  if (!robot.is_object() || !robot.contains("team") || !robot["team"].is_string()) return false;
  const auto number = robot.value("number", Json(1));
  const std::string team = robot["team"];
  return std::ranges::any_of(teamColors, [&](const TeamColorInfo& color) {
    return color.name == team && name == std::string(color.letter) + number.dump();
  });
}

/// A name stands for an object that begins with it.
void makeObject(Json& value, std::string_view key) {
  if (value.is_string()) {
    const std::string name = value;
    value = Json::object();
    value[key == "noise"       ? "preset"
          : key == "referee"   ? "rules"
          : key == "behaviour" ? "name"
                               : "base"] = name;
  }
  if (value.is_null()) value = Json::object();
}

Result<void> put(Json& into, std::string_view name, std::span<const Step> rest, const Json& value) {
  if (rest.empty()) {
    into = value;
    return {};
  }
  const Step& step = rest.front();
  const auto behind = rest.subspan(1);
  if (!step.inBrackets) {
    makeObject(into, name);
    if (!into.is_object()) return wrongKey(std::string(name) + " has no keys");
    return put(into[step.name], step.name, behind, value);
  }
  if (!into.is_array()) return wrongKey("the scenario has no list " + std::string(name));
  if (step.name == "*") {
    for (Json& entry : into) {
      TRY(put(entry, name, behind, value));
    }
    return {};
  }
  std::size_t index = 0;
  const char* const end = step.name.data() + step.name.size();
  const auto [stop, code] = std::from_chars(step.name.data(), end, index);
  if (code == std::errc() && stop == end) {
    if (index >= into.size()) {
      return wrongKey(std::string(name) + " has " + std::to_string(into.size()) +
                      " entries, counted from 0");
    }
    return put(into[index], name, behind, value);
  }
  for (Json& entry : into) {
    if (isRobot(entry, step.name)) return put(entry, name, behind, value);
  }
  return wrongKey("there is no robot " + step.name + " in the scenario");
}

}  // namespace

Json jsonOf(const JsonNode& node) {
  switch (node.kind) {
    case JsonNode::Kind::Null:
      return nullptr;
    case JsonNode::Kind::Boolean:
      return node.boolean;
    case JsonNode::Kind::Number:
      if (node.whole) return *node.whole;
      return node.number;
    case JsonNode::Kind::Text:
      return node.text;
    case JsonNode::Kind::Array: {
      Json out = Json::array();
      for (const JsonNode& item : node.items) out.push_back(jsonOf(item));
      return out;
    }
    case JsonNode::Kind::Object:
      break;
  }
  Json out = Json::object();
  for (const auto& [key, member] : node.members) out[key] = jsonOf(member);
  return out;
}

Result<void> putValue(Json& scenario, std::string_view key, const Json& value) {
  const auto steps = TRY(stepsOf(key));
  const std::string& first = steps.front().name;
  if (first == "stop" || first == "seed") {
    return wrongKey("\"" + first + "\" is set by the experiment itself");
  }
  if (!scenario.is_object()) return wrongKey("the scenario is not an object");
  return put(scenario[first], first, std::span(steps).subspan(1), value);
}

}  // namespace pitchboard::link
