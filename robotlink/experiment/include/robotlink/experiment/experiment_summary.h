// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all runs of an experiment say together: a summary of each metric in each condition,
// differences between conditions, comparisons with given figures, and whether the assertions hold.
// Computed from results in any order. Plain values; any thread.

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

/// All results, column by column: 8 bytes for each metric of a run.
struct ResultTable {
  explicit ResultTable(const Experiment& experiment);
  void add(const Experiment& experiment, const RunResult& result);

  std::vector<MetricInfo> metrics;
  struct OfCondition {
    /// By metric, then by index of the run; NaN where there is none.
    std::vector<std::vector<double>> columns;
    std::vector<char> played;
    std::map<std::string, std::size_t> ends;  ///< MatchResult::endedBy -> how often
    struct Outcome {
      int goals = 0, goalsAgainst = 0;  ///< of the experiment's team
      bool repeatable = true;
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
  std::size_t unrepeatable = 0;  ///< runs that would end differently when played again
  std::vector<Summary> metrics;
};

/// Of two conditions and one metric.
struct ConditionDifference {
  std::size_t first = 0, second = 0, metric = 0;  ///< second - first
  Comparison comparison;
  PairedDifference paired;  ///< with common random numbers
};

struct GivenComparison {
  std::size_t condition = 0, metric = 0, figure = 0;
  SampleMoments ours, theirs;  ///< a deviation that was not given is NaN
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
  std::vector<GivenComparison> comparisons;
  std::vector<CheckedAssertion> assertions;
  std::optional<TournamentTable> tournament{};
  /// Every assertion does, and nothing went wrong in a match of a tournament.
  bool holds() const;
};

ExperimentSummary summarize(const Experiment& experiment, const ResultTable& table);

/// The value of an expression over metrics, "goals - goals_against", in every run of a condition by
/// its index. NaN where it has none. Error NotFound for an unknown metric.
Result<std::vector<double>> valuesOf(std::string_view expression, const ResultTable& table,
                                     std::size_t condition);

/// Metrics that say something: some run has a value, and not all values of all conditions are 0.
std::vector<std::size_t> tellingMetrics(const ExperimentSummary& summary);

}  // namespace pitchboard::link
