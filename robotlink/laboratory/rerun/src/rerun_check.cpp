// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rerun/rerun_check.h>

#include <algorithm>
#include <cmath>

#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/experiment/junit_report.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t maxCheckText = 1000, maxChecks = 1000, maxCheckBytes = std::size_t{1} << 20;
constexpr const char *differencesMetric = "differences", *secondsMetric = "different_s";

std::optional<double> timeOf(const JsonObject& object, std::string_view key) {
  const JsonNode* node = object.find(key);
  if (!node) return {};
  if (node->kind == JsonNode::Kind::Number) return node->number;
  const auto seconds =
      node->kind == JsonNode::Kind::Text ? secondsFromText(node->text) : std::nullopt;
  if (!seconds) object.fail(key, std::string("must be a time: ") + timeForms);
  return seconds;
}

std::string textOf(const JsonNode& node, JsonReport& report, const std::string& path) {
  if (node.kind == JsonNode::Kind::Text) return node.text;
  report.fail(node.line, path, "must be a text such as \"mean(DECISION_ACTION_A) < 4\"");
  return {};
}

}  // namespace

Result<RerunCheck> RerunCheck::fromFile(const std::string& path) {
  return fromJson(TRY(readFile(path, maxCheckBytes)), path);
}

Result<RerunCheck> RerunCheck::fromJson(std::string_view text, std::string_view source) {
  JsonReport report(source);
  RerunCheck out;
  if (const auto root = parseJson(text, report, maxCheckBytes)) {
    const JsonObject file(report, *root, "", {"version", "name", "measures", "assertions"});
    file.require("assertions");
    (void)file.integer("version", 1, 1, 1);
    out.m_name = file.text("name", "rerun", maxCheckText);
    if (const JsonNode* measures = file.find("measures")) {
      const JsonObject all(report, *measures, "measures");
      for (const auto& [name, value] : all.members()) {
        out.m_measures.push_back({name, textOf(value, report, "measures." + name)});
      }
    }
    if (const auto* assertions = file.array("assertions", maxChecks)) {
      for (std::size_t i = 0; i < assertions->size(); ++i) {
        const JsonNode& node = (*assertions)[i];
        const std::string path = file.pathOf("assertions", i);
        if (node.kind != JsonNode::Kind::Object) {
          out.m_assertions.push_back({textOf(node, report, path), {}, {}});
          continue;
        }
        const JsonObject one(report, node, path, {"check", "from", "until"});
        one.require("check");
        out.m_assertions.push_back(
            {one.text("check", "", maxCheckText), timeOf(one, "from"), timeOf(one, "until")});
      }
      if (assertions->empty()) file.fail("assertions", "has nothing to check");
    }
  }
  if (report.failed()) return tl::unexpected(report.error());
  return out;
}

/// Finds out which values the assertions need.
Result<void> RerunCheck::begin(std::span<const ComparedVariable> variables) {
  for (const ComparedVariable& variable : variables) {
    m_metrics.push_back({variable.column.name, variable.column.unit, variable.column.name});
  }
  for (Measure& measure : m_measures) {
    auto check =
        Check::parse(measure.text, Check::Over::Run, std::span(m_metrics).first(variables.size()));
    if (!check) {
      check.error().context = "measures." + measure.name;
      return tl::unexpected(check.error());
    }
    measure.check = std::make_shared<Check>(std::move(*check));
    m_metrics.push_back({measure.name, {}, measure.name});
  }
  m_metrics.push_back({differencesMetric, {}, differencesMetric});
  m_metrics.push_back({secondsMetric, "s", secondsMetric});
  for (std::size_t i = 0; i < m_assertions.size(); ++i) {
    auto check = Check::parse(m_assertions[i].text, Check::Over::Condition, m_metrics);
    if (!check) {
      check.error().context = "assertions[" + std::to_string(i) + "]";
      return tl::unexpected(check.error());
    }
    for (const Check::Name& name : check->names()) m_values[name.metric];
  }
  return {};
}

void RerunCheck::add(double time, std::span<const ComparedVariable> variables,
                     std::span<const ComparedValue> values) {
  if (!std::exchange(m_begun, true)) {
    if (auto begun = begin(variables); !begun) m_error = begun.error();
  }
  if (m_error) return;
  m_times.push_back(time);
  for (auto& [metric, kept] : m_values) {
    if (metric < values.size()) {
      kept.push_back(values[metric].rerun);
    } else if (metric - values.size() < m_measures.size()) {
      Check& check = *m_measures[metric - values.size()].check;
      std::vector<double> named;
      for (const Check::Name& name : check.names()) named.push_back(values[name.metric].rerun);
      kept.push_back(check.value(named));
    }
  }
}

Result<std::vector<CheckedAssertion>> RerunCheck::judge(const RerunResult& result) const {
  if (m_error) return tl::unexpected(*m_error);
  double seconds = 0.0;
  for (const ComparedVariable& variable : result.variables) seconds += variable.seconds;
  std::vector<CheckedAssertion> out;
  for (const Assertion& assertion : m_assertions) {
    const auto valuesOf = [&](std::size_t metric, bool) {
      if (m_metrics[metric].name == differencesMetric) {
        return std::vector<double>{static_cast<double>(result.stretches())};
      }
      if (m_metrics[metric].name == secondsMetric) return std::vector<double>{seconds};
      std::vector<double> values;
      const std::vector<double>& all = m_values.at(metric);
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (assertion.from && m_times[i] < *assertion.from) continue;
        if (assertion.until && m_times[i] > *assertion.until) continue;
        values.push_back(all[i]);
      }
      return values;
    };
    out.push_back(checkedBy(assertion.text, m_name, m_metrics, valuesOf));
  }
  return out;
}

std::string rerunJunit(const std::string& name, std::vector<CheckedAssertion> checked) {
  TestedExperiment tested;
  tested.experiment.name = name;
  ConditionSummary& condition = tested.summary.conditions.emplace_back();
  condition.name = checked.empty() ? name : checked.front().condition;
  tested.summary.assertions = std::move(checked);
  return junitReport(std::span(&tested, 1));
}

}  // namespace pitchboard::link
