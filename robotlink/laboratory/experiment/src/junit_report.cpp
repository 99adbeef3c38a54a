// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/junit_report.h>

#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

constexpr const char* head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
constexpr const char* foot = "</testsuites>\n";

/// A test suite that is being written.
class Suite {
 public:
  Suite(std::string name, std::string group) : m_name(std::move(name)), m_group(std::move(group)) {}

  /// `failure`: empty if the test passed. `skipped`: why it was not carried out.
  void add(const std::string& name, const std::string& failure, const std::string& skipped = {}) {
    ++m_count;
    m_tests += "    <testcase classname=\"" + escaped(m_group) + "\" name=\"" + escaped(name) + '"';
    if (failure.empty() && skipped.empty()) {
      m_tests += "/>\n";
      return;
    }
    ++(failure.empty() ? m_skipped : m_failures);
    m_tests += std::string(">\n      <") + (failure.empty() ? "skipped" : "failure") +
               " message=\"" + escaped(failure.empty() ? skipped : failure) +
               "\"/>\n    </testcase>\n";
  }
  std::string text() const {
    return "  <testsuite name=\"" + escaped(m_name) + "\" tests=\"" + std::to_string(m_count) +
           "\" failures=\"" + std::to_string(m_failures) + '"' +
           (m_skipped > 0 ? " skipped=\"" + std::to_string(m_skipped) + '"' : "") + ">\n" +
           m_tests + "  </testsuite>\n";
  }

 private:
  std::string m_name, m_group, m_tests;
  std::size_t m_count = 0, m_failures = 0, m_skipped = 0;
};

void add(const CheckedAssertion& one, Suite& suite) {
  suite.add(one.condition + ": " + one.text, one.holds ? "" : one.values);
}

/// A test for each assertion, and one for each match in which something went wrong.
std::string tournamentSuite(const Experiment& experiment, const ExperimentSummary& summary) {
  Suite suite(experiment.name, experiment.name);
  for (const CheckedAssertion& one : summary.assertions) add(one, suite);
  const auto& wrong = summary.tournament->wrong;
  for (const auto& [number, what] : wrong) {
    const RunPlace place = placeOf(experiment, number);
    suite.add("run " + std::to_string(number) + ": " + experiment.conditions[place.condition].name +
                  ", seed " + std::to_string(seedOf(experiment, place)),
              what);
  }
  if (wrong.empty()) suite.add("no match had a problem", "");
  return suite.text();
}

std::string suites(const Experiment& experiment, const ExperimentSummary& summary) {
  if (summary.tournament) return tournamentSuite(experiment, summary);
  std::string out;
  for (const ConditionSummary& condition : summary.conditions) {
    Suite suite(experiment.name + ": " + condition.name, experiment.name);
    for (const CheckedAssertion& one : summary.assertions) {
      if (one.condition == condition.name) add(one, suite);
    }
    out += suite.text();
  }
  return out;
}

std::string errorSuite(const std::string& name, const std::string& error,
                       const char* test = "can be played") {
  return "  <testsuite name=\"" + escaped(name) +
         "\" tests=\"1\" failures=\"0\" errors=\"1\">\n    <testcase classname=\"" + escaped(name) +
         "\" name=\"" + test + "\">\n      <error message=\"" + escaped(error) +
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

std::string junitReport(std::span<const JunitSuite> suites) {
  std::string out = head;
  for (const JunitSuite& one : suites) {
    if (!one.error.empty()) {
      out += errorSuite(one.name, one.error, "can be read");
      continue;
    }
    Suite suite(one.name, one.name);
    for (const JunitSuite::Test& test : one.tests) suite.add(test.name, test.failure, test.skipped);
    out += suite.text();
  }
  return out + foot;
}

std::string junitReport(const Experiment& experiment, const ExperimentSummary& summary) {
  return head + suites(experiment, summary) + foot;
}

}  // namespace pitchboard::link
