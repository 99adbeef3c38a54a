// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Expressions over metrics: what a good run is ("goal && time_s < 60"), and what must hold of a
// condition ("goal_rate >= 0.5", "p95(belief_error_m) < 0.3"). One object for one thread.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/experiment/experiment_summary.h>
#include <robotlink/experiment/run_result.h>
#include <telemetry/expression/expression.h>

namespace pitchboard::link {

class Check {
 public:
  enum class Over {
    Run,       ///< names are values of one run
    Condition  ///< names are means of all runs, or mean(), median(), sd(), min(), max(), p95(), n()
  };
  static Result<Check> parse(std::string_view text, Over over, std::span<const MetricInfo> metrics);

  /// What stands in it: which metric, and which of its statistics ("value" over a run).
  struct Name {
    std::size_t metric = 0;
    std::string statistic;
    std::string written;  ///< as in the text
  };
  std::span<const Name> names() const { return m_names; }
  /// `values` in the order of names(). NaN if it depends on one that is unknown.
  double value(std::span<const double> values);
  /// NaN counts as not true.
  bool holds(std::span<const double> values);

 private:
  Check(telemetry::Expression expression, std::vector<Name> names)
      : m_expression(std::move(expression)), m_names(std::move(names)) {}
  telemetry::Expression m_expression;
  std::vector<Name> m_names;
};

/// "low95" and "high95", the ends of the interval of the mean.
bool isInterval(std::string_view statistic);
/// "mean", "p95", "low95", ... of the finite values; NaN where there are none. `rate`: they are 0
/// or 1.
double statisticOf(std::string_view statistic, std::span<const double> values, bool rate = false);

/// An assertion over what `valuesOf` gives of a metric: the values of all runs, or (for intervals)
/// what the bootstrap draws.
CheckedAssertion checkedBy(
    const std::string& text, const std::string& condition, std::span<const MetricInfo> metrics,
    const std::function<std::vector<double>(std::size_t metric, bool forInterval)>& valuesOf);

}  // namespace pitchboard::link
