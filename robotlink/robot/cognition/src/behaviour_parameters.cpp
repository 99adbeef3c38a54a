// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/cognition/behaviour_parameters.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include <base/read_file.h>
#include <resources/resources.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/models/model_json.h>
#include <simcore/world/parameter_reading.h>

namespace pitchboard::link {
namespace {

// What versions up to 0.11 had and wrote: read, and without effect. Robots decide by time now.
constexpr std::array<std::string_view, 6> formerKeys{
    "leaves_ball",          "takes_ball",     "supporter_leaves_ball",
    "supporter_takes_ball", "support_behind", "support_beside"};

constexpr std::size_t maxParameterBytes = 64 * kibibyte;

/// Any of the numbers.
BehaviourParameters readNumbers(const JsonNode& node, JsonReport& report, const std::string& path) {
  std::vector<std::string_view> keys;
  for (const BehaviourParameter& parameter : behaviourParameters) keys.emplace_back(parameter.key);
  const JsonObject object(report, node, path, keys);
  BehaviourParameters out;
  for (const BehaviourParameter& parameter : behaviourParameters) {
    if (!object.find(parameter.key)) continue;
    out.*parameter.member =
        parameter.stored(object.number(parameter.key, 0.0, sim::rangeOf(parameter)));
  }
  return out;
}

BehaviourParameters readFrom(const JsonNode& node, JsonReport& report, const std::string& path) {
  if (node.kind == JsonNode::Kind::Object) return readNumbers(node, report, path);
  if (node.kind != JsonNode::Kind::Text) {
    report.fail(node.line, path, "must be the name of a file, in quotes, or an object in braces");
    return {};
  }
  const auto loaded = loadBehaviourParameters(node.text);
  if (loaded) return *loaded;
  report.fail(node.line, path, loaded.error().text());
  return {};
}

/// With the numbers of `usual` that this behaviour reads.
BehaviourChoice choiceOf(std::string_view name, const BehaviourParameters& usual) {
  BehaviourChoice choice{std::string(name), {}};
  for (const BehaviourParameter& parameter : behaviourParameters) {
    if (parameter.isOf(name)) choice.parameters.*parameter.member = usual.*parameter.member;
  }
  return choice;
}

BehaviourChoice readBehaviourObject(const JsonNode& node, JsonReport& report,
                                    const std::string& path,
                                    std::span<const std::string_view> known,
                                    const BehaviourParameters& usual = {}) {
  // The name says which numbers there may be.
  const auto chosen = JsonObject(report, node, path).choice("name", known, "behaviour");
  const std::string name = chosen ? std::string(known[*chosen]) : BehaviourChoice().name;
  const JsonNode* from = node.find("from");
  BehaviourChoice choice = choiceOf(name, from ? readFrom(*from, report, path + ".from") : usual);
  if (report.failed()) return choice;
  std::vector<std::string_view> keys{"name", "from"};
  for (const BehaviourParameter& parameter : behaviourParameters) {
    if (parameter.isOf(choice.name)) keys.emplace_back(parameter.key);
  }
  keys.insert(keys.end(), formerKeys.begin(), formerKeys.end());
  const JsonObject object(report, node, path, keys);
  for (const BehaviourParameter& parameter : behaviourParameters) {
    if (!parameter.isOf(choice.name) || !object.find(parameter.key)) continue;
    choice.parameters.*parameter.member =
        parameter.stored(object.number(parameter.key, 0.0, sim::rangeOf(parameter)));
  }
  return choice;
}

}  // namespace

bool BehaviourParameter::isOf(std::string_view behaviour) const {
  return !behaviour.empty() && std::ranges::find(of, behaviour) != of.end();
}

BehaviourChoice readBehaviour(const JsonObject& parent, JsonReport& report, std::string_view key,
                              std::span<const std::string_view> known) {
  BehaviourChoice choice;
  const JsonNode* node = parent.find(key);
  if (!node || report.failed()) return choice;
  if (node->kind == JsonNode::Kind::Object) {
    return readBehaviourObject(*node, report, parent.pathOf(key), known);
  }
  if (node->kind != JsonNode::Kind::Text) {
    parent.fail(key, "must be the name of a behaviour, in quotes, or an object in braces");
    return choice;
  }
  if (const auto name = parent.choice(key, known, "behaviour")) choice.name = known[*name];
  return choice;
}

Result<BehaviourChoice> behaviourFromText(std::string_view nameOrJson, std::string_view source,
                                          const BehaviourParameters& usual) {
  std::vector<std::string_view> known;
  for (const BehaviourInfo& info : behaviours()) known.push_back(info.name);
  if (nameOrJson.find('{') == std::string_view::npos) {
    if (findBehaviour(nameOrJson)) return choiceOf(nameOrJson, usual);
    return failure(ErrorCode::NotFound, unknownName("behaviour", nameOrJson, known),
                   std::string(source));
  }
  JsonReport report(source);
  const auto root = parseJson(nameOrJson, report);
  BehaviourChoice choice;
  if (root) choice = readBehaviourObject(*root, report, "behaviour", known, usual);
  if (report.failed()) return tl::unexpected(report.error());
  return choice;
}

std::span<const std::string_view> builtInParameters() {
  static const auto names = resourceNames("behaviours", {"learned", "hand-tuned"});
  return names;
}

Result<BehaviourParameters> loadBehaviourParameters(const std::string& nameOrPath) {
  const bool isBuiltIn =
      std::ranges::find(builtInParameters(), nameOrPath) != builtInParameters().end();
  Result<std::string> text =
      isBuiltIn ? std::string(resourceText("behaviours/" + nameOrPath + ".json"))
                : readFile(nameOrPath, maxParameterBytes, "the file with parameters");
  if (!text && text.error().code == ErrorCode::NotFound &&
      nameOrPath.find_first_of("/.") == std::string::npos) {
    return failure(ErrorCode::NotFound,
                   unknownName("built-in parameters and no file", nameOrPath, builtInParameters()));
  }
  if (!text) return tl::unexpected(text.error());
  JsonReport report(nameOrPath);
  const auto root = parseJson(*text, report);
  BehaviourParameters out;
  if (root) {
    // "learned" says how they were found (docs/learning.md).
    const JsonObject file(report, *root, "", {"version", "name", "parameters", "learned"});
    for (const std::string_view key : {"version", "parameters"}) file.require(key);
    (void)file.integer("version", 1, 1, 1);
    if (const JsonNode* numbers = file.find("parameters")) {
      out = readNumbers(*numbers, report, "parameters");
    }
  }
  if (report.failed()) return tl::unexpected(report.error());
  return out;
}

std::string behaviourToText(std::string_view name, const BehaviourParameters& parameters) {
  const BehaviourParameters usual;
  nlohmann::ordered_json out{{"name", name}};
  for (const BehaviourParameter& p : behaviourParameters) {
    const double value = parameters.*p.member;
    if (!p.isOf(name) || value == usual.*p.member) continue;
    out[p.key] = jsonNumber(p.unit.angle ? fileDegrees(value) : value);
  }
  return out.size() > 1 ? out.dump() : std::string(name);
}

Result<void> validate(const BehaviourParameters& parameters) {
  for (const BehaviourParameter& p : behaviourParameters) {
    const double value = parameters.*p.member;
    if (value >= p.stored(p.least) && value <= p.stored(p.most)) continue;
    const std::string unit = *p.unit.name ? std::string(" ") + p.unit.name : std::string();
    return failure(ErrorCode::InvalidArgument,
                   "must lie between " + shortest(p.least) + " and " + shortest(p.most) + unit,
                   std::string("behaviour.") + p.key);
  }
  return {};
}

}  // namespace pitchboard::link
