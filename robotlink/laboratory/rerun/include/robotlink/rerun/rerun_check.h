// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What must hold of the new outputs of a rerun: a JSON file with assertions in the language of
// situation tests (docs/experiments.md). Each moment that is compared is what a run is there: an
// output variable is a metric, and so is a measure, an expression over the outputs of a moment.
// Metrics of the whole rerun are `differences` and `different_s`. One thread; seconds of the
// session.

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/experiment/checks.h>
#include <robotlink/rerun/rerun.h>

namespace pitchboard::link {

class RerunCheck {
 public:
  /// Reads a file. Fails with ParseError and the place, or as readFile() does.
  static Result<RerunCheck> fromFile(const std::string& path);
  static Result<RerunCheck> fromJson(std::string_view text, std::string_view source);

  /// Adds a moment; see RerunOptions::compared.
  void add(double time, std::span<const ComparedVariable> variables,
           std::span<const ComparedValue> values);
  /// Judges the assertions. Fails with NotFound if one names a variable that is no output.
  Result<std::vector<CheckedAssertion>> judge(const RerunResult& result) const;

  const std::string& name() const { return m_name; }

 private:
  struct Assertion {
    std::string text;
    std::optional<double> from, until;
  };
  struct Measure {
    std::string name, text;
    std::shared_ptr<Check> check{};  // shared: Check can only be moved
  };
  Result<void> begin(std::span<const ComparedVariable> variables);

  std::string m_name;
  std::vector<Measure> m_measures;
  std::vector<Assertion> m_assertions;

  bool m_begun = false;
  std::optional<Error> m_error;
  std::vector<MetricInfo> m_metrics;  // the outputs, the measures, those of the whole
  std::vector<double> m_times;
  std::map<std::size_t, std::vector<double>> m_values;  // of the metrics that assertions name
};

/// Returns assertions as JUnit XML, a suite with a test each.
std::string rerunJunit(const std::string& name, std::vector<CheckedAssertion> checked);

}  // namespace pitchboard::link
