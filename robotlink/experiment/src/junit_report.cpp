// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/junit_report.h>

#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

constexpr const char* head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
constexpr const char* foot = "</testsuites>\n";

std::string suites(const Experiment& experiment, const ExperimentSummary& summary) {
  std::string out;
  for (const ConditionSummary& condition : summary.conditions) {
    std::string tests;
    std::size_t count = 0, failures = 0;
    for (const CheckedAssertion& one : summary.assertions) {
      if (one.condition != condition.name) continue;
      ++count;
      tests += "    <testcase classname=\"" + escaped(experiment.name) + "\" name=\"" +
               escaped(one.condition + ": " + one.text) + '"';
      if (one.holds) {
        tests += "/>\n";
        continue;
      }
      ++failures;
      tests += ">\n      <failure message=\"" + escaped(one.values) + "\"/>\n    </testcase>\n";
    }
    out += "  <testsuite name=\"" + escaped(experiment.name + ": " + condition.name) +
           "\" tests=\"" + std::to_string(count) + "\" failures=\"" + std::to_string(failures) +
           "\">\n" + tests + "  </testsuite>\n";
  }
  return out;
}

std::string errorSuite(const std::string& name, const std::string& error) {
  return "  <testsuite name=\"" + escaped(name) +
         "\" tests=\"1\" failures=\"0\" errors=\"1\">\n    <testcase classname=\"" + escaped(name) +
         "\" name=\"can be played\">\n      <error message=\"" + escaped(error) +
         "\"/>\n    </testcase>\n  </testsuite>\n";
}

}  // namespace

std::string junitReport(std::span<const TestedExperiment> tested) {
  std::string out = head;
  for (const TestedExperiment& one : tested) {
    out += one.error.empty() ? suites(one.experiment, one.summary)
                             : errorSuite(one.experiment.name, one.error);
  }
  return out + foot;
}

std::string junitReport(const Experiment& experiment, const ExperimentSummary& summary) {
  return head + suites(experiment, summary) + foot;
}

}  // namespace pitchboard::link
