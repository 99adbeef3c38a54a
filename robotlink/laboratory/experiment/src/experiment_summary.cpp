// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/experiment_summary.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/try.h>
#include <robotlink/experiment/checks.h>

#include "tournament_parts.h"

namespace pitchboard::link {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t metricIndex(const std::vector<MetricInfo>& metrics, const std::string& name) {
  const auto found = std::ranges::find(metrics, name, &MetricInfo::name);
  return static_cast<std::size_t>(found - metrics.begin());
}

ResultTable::OfCondition::Outcome outcomeOf(TeamColor team, const RunResult& result) {
  const MatchResult& match = result.match;
  const bool second = match.teams[1].colour == team;
  const TeamResult &ours = match.teams[second ? 1 : 0], &theirs = match.teams[second ? 0 : 1];
  return {ours.score, theirs.score, ours.wonToss - theirs.wonToss, match.repeatable, result.hash};
}

bool playedIdentically(const ResultTable::OfCondition& one, const ResultTable::OfCondition& other) {
  return one.count() > 0 && one.played == other.played &&
         std::ranges::equal(one.outcomes, other.outcomes, {},
                            &ResultTable::OfCondition::Outcome::hash,
                            &ResultTable::OfCondition::Outcome::hash);
}

std::vector<IdenticalConditions> identicalConditions(const ResultTable& table) {
  std::vector<IdenticalConditions> out;
  for (std::size_t second = 1; second < table.conditions.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      if (!playedIdentically(table.conditions[first], table.conditions[second])) continue;
      out.push_back({first, second});
      break;
    }
  }
  return out;
}

}  // namespace

ResultTable::ResultTable(const Experiment& experiment)
    : metrics(metricsOf(experiment)), conditions(experiment.conditions.size()) {
  for (OfCondition& condition : conditions) {
    condition.columns.assign(metrics.size(), std::vector<double>(experiment.runs, nan));
    condition.played.assign(experiment.runs, 0);
    condition.outcomes.resize(experiment.runs);
  }
}

std::size_t ResultTable::OfCondition::count() const {
  return static_cast<std::size_t>(std::ranges::count(played, 1));
}

std::size_t ResultTable::OfCondition::countUnrepeatable() const {
  return static_cast<std::size_t>(std::ranges::count(outcomes, false, &Outcome::repeatable));
}

void ResultTable::add(const Experiment& experiment, const RunResult& result) {
  const RunPlace place = placeOf(experiment, result.number);
  OfCondition& condition = conditions[place.condition];
  if (condition.played[place.index]) return;
  condition.played[place.index] = 1;
  ++condition.ends[result.match.endedBy];
  condition.outcomes[place.index] = outcomeOf(experiment.conditions[place.condition].team, result);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    condition.columns[i][place.index] = result.values[i];
  }
  if (result.paths.empty()) return;
  const auto after = std::ranges::find_if(
      condition.drawn, [&](const OfCondition::Drawn& one) { return one.number > result.number; });
  condition.drawn.insert(after, {result.number, result.match.endedBy, result.paths});
}

bool ExperimentSummary::holds() const {
  return (!tournament || tournament->wrong.empty()) &&
         std::ranges::all_of(assertions, [](const CheckedAssertion& one) { return one.holds; });
}

ExperimentSummary summarize(const Experiment& experiment, const ResultTable& table) {
  ExperimentSummary out;
  out.metrics = table.metrics;
  for (std::size_t c = 0; c < experiment.conditions.size(); ++c) {
    const ResultTable::OfCondition& rows = table.conditions[c];
    ConditionSummary condition{
        experiment.conditions[c].name, rows.count(), rows.ends, rows.countUnrepeatable(), {}};
    for (std::size_t m = 0; m < out.metrics.size(); ++m) {
      condition.metrics.push_back(summaryOf(rows.columns[m], out.metrics[m].rate));
    }
    out.conditions.push_back(std::move(condition));
  }
  for (std::size_t c = 1; c < out.conditions.size(); ++c) {
    for (std::size_t m = 0; m < out.metrics.size(); ++m) {
      const Summary &first = out.conditions[0].metrics[m], &second = out.conditions[c].metrics[m];
      if (first.moments.count == 0 || second.moments.count == 0) continue;
      ConditionDifference difference{
          0, c, m, compared(second.moments, first.moments, out.metrics[m].rate), {}};
      if (experiment.commonSeeds) {
        difference.paired =
            pairedDifference(table.conditions[c].columns[m], table.conditions[0].columns[m]);
      }
      out.differences.push_back(difference);
    }
  }
  if (experiment.commonSeeds && !experiment.tournament) out.identical = identicalConditions(table);
  for (std::size_t f = 0; f < experiment.given.size(); ++f) {
    const GivenFigure& figure = experiment.given[f];
    const std::size_t metric = metricIndex(out.metrics, figure.metric);
    for (std::size_t c = 0; c < out.conditions.size(); ++c) {
      const auto& only = figure.conditions;
      if (!only.empty() && std::ranges::find(only, out.conditions[c].name) == only.end()) continue;
      const SampleMoments ours = out.conditions[c].metrics[metric].moments;
      const SampleMoments theirs{figure.mean, figure.deviation.value_or(nan), figure.count};
      out.comparisons.push_back(
          {c, metric, f, ours, theirs, compared(ours, theirs, out.metrics[metric].rate)});
    }
  }
  for (const Assertion& assertion : experiment.assertions) {
    for (std::size_t c = 0; c < out.conditions.size(); ++c) {
      const std::string& name = out.conditions[c].name;
      if (!assertion.condition.empty() && assertion.condition != name) continue;
      out.assertions.push_back(
          checkedBy(assertion.text, name, table.metrics,
                    [&](std::size_t metric, bool) { return table.conditions[c].columns[metric]; }));
    }
  }
  if (experiment.tournament) {
    out.tournament = tableOf(experiment, table);
    out.assertions = checkedAssertions(experiment, table);
  }
  return out;
}

Result<std::vector<double>> valuesOf(std::string_view expression, const ResultTable& table,
                                     std::size_t condition) {
  auto check = TRY(Check::parse(expression, Check::Over::Run, table.metrics));
  const ResultTable::OfCondition& rows = table.conditions[condition];
  std::vector<double> out;
  for (std::size_t i = 0; i < rows.played.size(); ++i) {
    std::vector<double> values;
    for (const Check::Name& name : check.names()) values.push_back(rows.columns[name.metric][i]);
    out.push_back(check.value(values));
  }
  return out;
}

std::vector<std::string> identicalTexts(const ExperimentSummary& summary) {
  std::vector<std::string> out;
  for (const auto& [first, second] : summary.identical) {
    const std::size_t runs = summary.conditions[second].runs;
    out.push_back("\"" + summary.conditions[first].name + "\" and \"" +
                  summary.conditions[second].name + "\" played identically: " +
                  (runs == 1 ? "the run ends" : "all " + std::to_string(runs) + " runs end") +
                  " in the same state. What differs between them has no effect in this scenario.");
  }
  return out;
}

std::vector<std::size_t> informativeMetrics(const ExperimentSummary& summary) {
  std::vector<std::size_t> out;
  for (std::size_t m = 0; m < summary.metrics.size(); ++m) {
    const bool isInformative =
        std::ranges::any_of(summary.conditions, [m](const ConditionSummary& one) {
          const Summary& s = one.metrics[m];
          return s.moments.count > 0 && (s.least != 0.0 || s.most != 0.0);
        });
    if (isInformative) out.push_back(m);
  }
  return out;
}

}  // namespace pitchboard::link
