// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/variable_meanings.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

#include <base/lined_json.h>
#include <base/wildcard.h>
#include <resources/resources.h>
#include <simcore/world/action_codes.h>

namespace pitchboard::link {
namespace {

constexpr std::array<std::string_view, 3> kinds{"number", "flag", "enumeration"};
constexpr std::size_t longestText = 200, maxRules = 1000;

/// The variable that `lostBy` means for `name`, which fits `pattern`.
std::string lostByOf(std::string_view lostBy, std::string_view pattern, std::string_view name) {
  if (lostBy == "*") return std::string(name);
  std::string out(lostBy);
  const std::size_t star = out.find('*'), inName = pattern.find('*');
  if (star != std::string::npos && inName != std::string_view::npos) {
    out.replace(star, 1, name.substr(inName, name.size() + 1 - pattern.size()));
  }
  return out;
}

std::map<std::int32_t, std::string> readLabels(const JsonObject& rule) {
  const JsonNode* labels = rule.find("labels");
  if (!labels) return {};
  if (labels->kind == JsonNode::Kind::Text && labels->text == "actions") return actionLabels();
  std::map<std::int32_t, std::string> out;
  if (labels->kind != JsonNode::Kind::Object) {
    rule.fail("labels", R"(must be "actions" or an object of code and text)");
  }
  for (const auto& [key, value] : labels->members) {
    std::int32_t code = 0;
    const char* const end = key.data() + key.size();
    const auto read = std::from_chars(key.data(), end, code);
    if (read.ec != std::errc{} || read.ptr != end || value.kind != JsonNode::Kind::Text) {
      rule.fail("labels", "\"" + key + "\" must be a whole number with a text");
      break;
    }
    out[code] = value.text;
  }
  return out;
}

}  // namespace

bool fitsWildcard(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

Result<VariableMeanings> VariableMeanings::parse(std::string_view text, std::string_view source) {
  JsonReport report(source);
  VariableMeanings out;
  if (const auto root = parseJson(text, report)) {
    const JsonObject file(report, *root, "", {"about", "rules"});
    file.require("rules");
    if (const auto* rules = file.array("rules", maxRules)) {
      for (std::size_t i = 0; i < rules->size(); ++i) {
        const JsonObject json(
            report, (*rules)[i], "rules[" + std::to_string(i) + "]",
            {"name", "category", "unit", "kind", "labels", "description", "absent", "lost_by",
             "lost_when", "writer", "cleared_by", "also_by", "also_while"});
        json.require("name");
        Rule rule;
        rule.name = json.text("name", "", longestText);
        if (json.find("category")) rule.category = json.text("category", "", longestText);
        if (json.find("unit")) rule.unit = json.text("unit", "", longestText);
        if (json.find("kind")) {
          const auto kind = json.choice("kind", kinds, "kind");
          rule.kind = static_cast<telemetry::ColumnKind>(kind.value_or(0));
        }
        rule.labels = readLabels(json);
        rule.description = json.text("description", "", longestText);
        if (json.find("absent")) rule.absent = json.number("absent", 0.0, anyNumber);
        if (json.find("lost_by")) {
          rule.lostBy = json.text("lost_by", "", longestText);
          rule.lostWhen = json.number("lost_when", 1.0, anyNumber);
        }
        rule.writers = {
            json.text("writer", "", longestText), json.text("cleared_by", "", longestText),
            json.text("also_by", "", longestText), json.text("also_while", "", longestText)};
        out.m_rules.push_back(std::move(rule));
      }
    }
  }
  if (report.failed()) return tl::unexpected(report.error());
  return out;
}

const VariableMeanings& VariableMeanings::published() {
  static const VariableMeanings meanings = [] {
    constexpr std::string_view path = "variables.json";
    auto parsed = parse(resourceText(path), path);
    assert(parsed);  // a test reads it too
    return parsed ? std::move(*parsed) : VariableMeanings{};
  }();
  return meanings;
}

std::optional<double> VariableMeanings::absent(std::string_view name) const {
  for (const Rule& rule : m_rules) {
    if (rule.absent && fitsWildcard(rule.name, name)) return rule.absent;
  }
  return std::nullopt;
}

VariableWriters VariableMeanings::writers(std::string_view name) const {
  for (const Rule& rule : m_rules) {
    if (!rule.writers.writer.empty() && fitsWildcard(rule.name, name)) return rule.writers;
  }
  return {};
}

std::string_view VariableMeanings::description(std::string_view name) const {
  for (const Rule& rule : m_rules) {
    if (!rule.description.empty() && fitsWildcard(rule.name, name)) return rule.description;
  }
  return {};
}

void VariableMeanings::describe(telemetry::ColumnInfo& column) const {
  bool category = false, unit = false, kind = false;
  for (const Rule& rule : m_rules) {
    if (!fitsWildcard(rule.name, column.name)) continue;
    if (rule.category && !category) {
      column.category = *rule.category;
      category = true;
    }
    if (rule.unit && !unit) {
      column.unit = *rule.unit;
      unit = true;
    }
    if (rule.kind && !kind) {
      column.kind = *rule.kind;
      column.labels = rule.labels;
      kind = true;
    }
    if (rule.lostBy) {
      column.lost.push_back({lostByOf(*rule.lostBy, rule.name, column.name), rule.lostWhen});
    }
  }
}

void VariableMeanings::describeLost(telemetry::GroupInfo& group) const {
  const auto isGiven = [](const telemetry::ColumnInfo& column) { return !column.lost.empty(); };
  if (std::ranges::any_of(group.columns, isGiven)) return;
  // What a robot sends later than its first variables has Float64 columns; messages have, too.
  const bool isSent = !factsOf(group).sentFrom.empty();
  for (telemetry::ColumnInfo& column : group.columns) {
    if (column.type == telemetry::ColumnType::Int32) continue;
    if (column.type == telemetry::ColumnType::Float64 && !isSent) continue;
    telemetry::ColumnInfo known;
    known.name = column.name;
    describe(known);
    column.lost = std::move(known.lost);
  }
}

}  // namespace pitchboard::link
