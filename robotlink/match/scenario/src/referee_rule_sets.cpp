// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/scenario/referee_rule_sets.h>

#include <algorithm>

#include <resources/resources.h>
#include <simcore/world/referee_parameters.h>
#include <telemetry/referee/gamecontroller_encoder.h>

#include "referee_rules_json.h"
#include "scenario_keys.h"

namespace pitchboard::link {
namespace {

const std::vector<std::string_view>& setNames() {
  static const auto all = resourceNames("rules");
  return all;
}

constexpr std::string_view noReferee = "published";

std::vector<std::string_view> keysOfRules(std::vector<std::string_view> keys) {
  keys.push_back("style");
  keys = sim::withKeys(std::move(keys), sim::refereeCounts);
  keys = sim::withKeys(std::move(keys), sim::refereeParameters);
  for (const auto& one : sim::refereeSwitches) keys.push_back(one.key);
  return keys;
}

/// Only sizes that this version has; one that is left out is the version's.
void checkPackets(const JsonObject& object, sim::RefereeRules& rules) {
  const int version = rules.packetVersion;
  const auto size = telemetry::refereePacketSize(version, rules.packetSize);
  if (!size) {
    object.fail("packet_version",
                "no GameController sends packets of version " + std::to_string(version));
  } else if (object.find("packet_size") && *size != rules.packetSize) {
    object.fail("packet_size", "packets of version " + std::to_string(version) + " do not have " +
                                   std::to_string(rules.packetSize) + " bytes; for example " +
                                   std::to_string(*size));
  } else {
    rules.packetSize = *size;
  }
}

void readRules(const JsonObject& object, sim::RefereeRules& rules) {
  if (const auto style = object.choice("style", sim::refereeStyleNames, "style of referee")) {
    rules.style = static_cast<sim::RefereeStyle>(*style);
  }
  readNumbers(object, sim::refereeCounts, rules);
  readNumbers(object, sim::refereeParameters, rules);
  for (const auto& one : sim::refereeSwitches) {
    rules.*one.member = object.boolean(one.key, rules.*one.member);
  }
  checkPackets(object, rules);
}

struct RuleFile {
  RuleSetInfo info;
  sim::RefereeRules rules;
};

Result<RuleFile> readFileOf(std::string_view text, std::string_view source) {
  JsonReport report(source);
  const auto root = parseJson(text, report);
  RuleFile file;
  if (root) {
    const auto keys = keysOfRules({"name", "title", "description"});
    const JsonObject object(report, *root, "", keys);
    object.require("name");
    file.info = {object.text("name", "custom", 64), object.text("title", "", 200),
                 object.text("description", "", 5000)};
    file.rules.name = file.info.name;
    readRules(object, file.rules);
  }
  if (report.failed()) return tl::unexpected(report.error());
  return file;
}

Result<RuleFile> builtIn(std::string_view name) {
  const std::string path = "rules/" + std::string(name) + ".json";
  return readFileOf(resourceText(path), path);
}

std::vector<std::string_view> knownNames() {
  std::vector<std::string_view> known{noReferee};
  known.insert(known.end(), setNames().begin(), setNames().end());
  return known;
}

}  // namespace

std::vector<RuleSetInfo> refereeRuleSets() {
  std::vector<RuleSetInfo> all{
      {std::string(noReferee), "No referee",
       "As the published simulator: goals count, a ball that is out is put back."}};
  for (const std::string_view name : setNames()) {
    if (const auto file = builtIn(name)) all.push_back(file->info);
  }
  return all;
}

Result<std::optional<sim::RefereeRules>> refereeRuleSet(std::string_view name) {
  if (name == noReferee) return std::optional<sim::RefereeRules>();
  if (std::find(setNames().begin(), setNames().end(), name) == setNames().end()) {
    return failure(ErrorCode::NotFound, unknownName("rule set", name, knownNames()));
  }
  auto file = builtIn(name);
  if (!file) return tl::unexpected(file.error());
  return std::optional<sim::RefereeRules>(file->rules);
}

Result<sim::RefereeRules> refereeRulesFromJson(std::string_view text, std::string_view source) {
  auto file = readFileOf(text, source);
  if (!file) return tl::unexpected(file.error());
  return file->rules;
}

std::optional<sim::RefereeRules> readReferee(JsonReport& report, const JsonObject& parent,
                                             std::string_view key) {
  const JsonNode* node = parent.find(key);
  if (!node) return {};
  const std::vector<std::string_view> known = knownNames();
  const auto take = [&](std::size_t index) -> std::optional<sim::RefereeRules> {
    const auto set = refereeRuleSet(known[index]);
    return set ? *set : std::nullopt;
  };
  if (node->kind == JsonNode::Kind::Text) {
    const auto set = parent.choice(key, known, "rule set");
    return set ? take(*set) : std::nullopt;
  }
  if (node->kind != JsonNode::Kind::Object) {
    parent.fail(key, "must be the name of a rule set, in quotes, or an object in braces");
    return {};
  }
  const auto keys = keysOfRules({"rules"});
  const JsonObject object(report, *node, parent.pathOf(key), keys);
  sim::RefereeRules rules;
  if (const auto set = object.choice("rules", known, "rule set")) {
    const auto base = take(*set);
    if (!base) {
      object.fail("rules", "\"published\" has no referee whose rules could be changed");
      return {};
    }
    rules = *base;
  }
  readRules(object, rules);
  return rules;
}

}  // namespace pitchboard::link
