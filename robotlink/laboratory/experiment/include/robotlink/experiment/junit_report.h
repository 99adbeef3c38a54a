// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes assertions as JUnit XML for continuous integration. Each condition of an experiment is a
// test suite (a tournament is a single one), and each assertion is a test. A file that could not be
// read or played becomes a suite with an error. Pure functions; any thread.

#include <span>
#include <string>
#include <vector>

#include <robotlink/experiment/experiment_summary.h>

namespace pitchboard::link {

struct TestedExperiment {
  Experiment experiment;
  ExperimentSummary summary;
  std::string error;  ///< why there is no summary; if set, only the experiment's name is used
};

/// A suite whose tests are no assertions of an experiment.
struct JunitSuite {
  struct Test {
    std::string name;
    std::string failure{}, skipped{};  ///< why it failed or was skipped; both empty: it passed
  };
  std::string name;
  std::vector<Test> tests{};
  std::string error{};  ///< why there are no tests
};

std::string junitReport(std::span<const TestedExperiment> tested);
std::string junitReport(std::span<const JunitSuite> suites);
std::string junitReport(const Experiment& experiment, const ExperimentSummary& summary);

}  // namespace pitchboard::link
