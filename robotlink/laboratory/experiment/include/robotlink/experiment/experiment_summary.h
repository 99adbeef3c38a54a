// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Summarizes the runs of an experiment: each metric in each condition, differences between
// conditions, comparisons with given figures, and whether the assertions hold. The order in which
// results are added does not matter. Plain values; any thread.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/experiment/run_result.h>
#include <robotlink/experiment/statistics.h>
#include <robotlink/experiment/tournament.h>

namespace pitchboard::link {

/// All results as columns, with 8 bytes for each metric of a run.
struct ResultTable {
  explicit ResultTable(const Experiment& experiment);
  void add(const Experiment& experiment, const RunResult& result);

  std::vector<MetricInfo> metrics;
  struct OfCondition {
    /// By metric, then by index of the run; NaN if a run has no value.
    std::vector<std::vector<double>> columns;
    std::vector<char> played;                 ///< by index of the run
    std::map<std::string, std::size_t> ends;  ///< number of runs for each MatchResult::endedBy
    struct Outcome {
      int goals = 0, goalsAgainst = 0;  ///< from the view of the experiment's team
      int coin = 0;  ///< 1: a coin decided the shoot-out for that team, -1: for the other one
      bool repeatable = true;
      std::uint64_t hash = 0;  ///< of the last state
    };
    std::vector<Outcome> outcomes;  ///< by index of the run
    struct Drawn {
      std::size_t number = 0;
      std::string endedBy;
      std::vector<RunPath> paths;
    };
    std::vector<Drawn> drawn;  ///< in order of number
    std::size_t count() const;
    std::size_t countUnrepeatable() const;
  };
  std::vector<OfCondition> conditions;
};

struct ConditionSummary {
  std::string name;
  std::size_t runs = 0;
  std::map<std::string, std::size_t> ends;
  std::size_t unrepeatable = 0;  ///< runs that may end differently when played again
  std::vector<Summary> metrics;
};

/// The difference of a metric between two conditions, second - first. Members are indices.
struct ConditionDifference {
  std::size_t first = 0, second = 0, metric = 0;
  Comparison comparison;
  PairedDifference paired;  ///< only if both conditions use the same seeds
};

/// Two conditions whose runs all ended in the same state: what one sets and the other does not had
/// no effect. Members are indices.
struct IdenticalConditions {
  std::size_t first = 0, second = 0;
};

struct GivenComparison {
  std::size_t condition = 0, metric = 0, figure = 0;
  SampleMoments ours, theirs;  ///< a missing deviation is NaN
  Comparison comparison;       ///< ours - theirs
};

struct CheckedAssertion {
  std::string condition, text;
  bool holds = false;
  std::string values;  ///< "goal_rate = 0.43"
};

struct ExperimentSummary {
  std::vector<MetricInfo> metrics;
  std::vector<ConditionSummary> conditions;
  std::vector<ConditionDifference> differences;  ///< each condition against the first
  /// Of conditions with the same seeds: each that played identically to an earlier one, once.
  std::vector<IdenticalConditions> identical;
  std::vector<GivenComparison> comparisons;
  std::vector<CheckedAssertion> assertions;
  std::optional<TournamentTable> tournament{};
  /// Returns whether all assertions hold and no match of a tournament went wrong.
  bool holds() const;
};

ExperimentSummary summarize(const Experiment& experiment, const ResultTable& table);

/// Returns the value of an expression over metrics, such as "goals - goals_against", for every run
/// of a condition, in the order of its runs. NaN where a metric has no value. Error NotFound for an
/// unknown metric.
Result<std::vector<double>> valuesOf(std::string_view expression, const ResultTable& table,
                                     std::size_t condition);

/// Returns a sentence for each pair of conditions that played identically.
std::vector<std::string> identicalTexts(const ExperimentSummary& summary);

/// Returns the metrics worth showing: some run has a value, and not all values are 0.
std::vector<std::size_t> informativeMetrics(const ExperimentSummary& summary);

}  // namespace pitchboard::link
