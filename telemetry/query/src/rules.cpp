// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/rules.h>

#include <algorithm>
#include <cstdio>

#include <base/csv_field.h>
#include <base/identifier.h>
#include <base/read_file.h>
#include <base/try.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxRules = 200, maxRuleRobots = 100, maxRuleText = 2000, maxRuleName = 60;
constexpr std::size_t maxRulesBytes = std::size_t{1} << 20;
constexpr double longestRule = 1e6;  // s

Rule ruleOf(const JsonObject& object) {
  Rule rule;
  object.require("name");
  object.require("when");
  rule.name = object.text("name", "", maxRuleName);
  rule.question.condition = object.text("when", "", maxRuleText);
  rule.text = object.text("text", rule.question.condition, maxRuleText);
  rule.question.least = object.number("for", 0.0, {0.0, longestRule, "seconds"});
  if (const auto severity = object.choice("severity", ruleSeverityNames, "severity")) {
    rule.severity = static_cast<RuleSeverity>(*severity);
  }
  if (const auto* robots = object.array("robots", maxRuleRobots)) {
    for (const JsonNode& robot : *robots) {
      if (robot.kind != JsonNode::Kind::Text || robot.text.empty()) {
        object.fail("robots", "must be a list of names, such as [\"B1\"]");
        break;
      }
      rule.question.robots.push_back(robot.text);
    }
  }
  if (object.find("name") && !isIdentifier(rule.name)) {
    object.fail("name", "must be letters, digits and '_', beginning with a letter");
  }
  if (object.find("when")) {
    if (const auto right = checkQuestion(rule.question); !right) {
      object.fail("when", right.error().message);
    }
  }
  return rule;
}

}  // namespace

std::vector<Rule> rulesOf(const JsonObject& object, JsonReport& report) {
  std::vector<Rule> out;
  const auto* items = object.array("rules", maxRules);
  for (std::size_t i = 0; items && i < items->size(); ++i) {
    const JsonObject one(report, (*items)[i], object.pathOf("rules", i),
                         {"name", "text", "when", "for", "severity", "robots"});
    Rule rule = ruleOf(one);
    if (std::ranges::find(out, rule.name, &Rule::name) != out.end() && !rule.name.empty()) {
      one.fail("name", "another rule has this name");
    }
    out.push_back(std::move(rule));
  }
  if (items && items->empty()) object.fail("rules", "has no rule; add one");
  return out;
}

Result<std::vector<Rule>> rulesFromFile(const std::string& path) {
  return rulesFromJson(TRY(readFile(path, maxRulesBytes, "the rules")), path);
}

Result<std::vector<Rule>> rulesFromJson(std::string_view text, std::string_view source) {
  JsonReport report(source);
  std::vector<Rule> out;
  if (const auto root = parseJson(text, report, maxRulesBytes)) {
    const JsonObject file(report, *root, "", {"version", "rules"});
    file.require("version");
    file.require("rules");
    (void)file.integer("version", 1, 1, 1);
    out = rulesOf(file, report);
  }
  if (report.failed()) return tl::unexpected(report.allErrors());
  return out;
}

std::vector<MomentQuestion> questionsOf(const std::vector<Rule>& rules) {
  std::vector<MomentQuestion> out;
  for (const Rule& rule : rules) out.push_back(rule.question);
  return out;
}

std::string brokenRuleCsvHead() {
  return "session,rule,severity,robot,from,until,value,value_time\n";
}

std::string brokenRuleCsv(const std::string& session, const Rule& rule, const FoundMoment& moment) {
  char numbers[120];
  std::snprintf(numbers, sizeof numbers, "%.9g,%.9g,", moment.range.begin, moment.range.end);
  std::string out = csvField(session) + ',' + rule.name + ',' + std::string(nameOf(rule.severity)) +
                    ',' + csvField(moment.robot) + ',' + numbers;
  if (!moment.value) return out + ",\n";
  std::snprintf(numbers, sizeof numbers, "%.9g,%.9g\n", *moment.value, moment.valueAt);
  return out + numbers;
}

}  // namespace pitchboard::telemetry
