// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Assertions as JUnit XML, which continuous integration reads: a test suite for each condition of
// an experiment (one for a tournament), a test for each of its assertions; a suite with an error
// for a file that could not be read or played. Pure; any thread.

#include <span>
#include <string>

#include <robotlink/experiment/experiment_summary.h>

namespace pitchboard::link {

struct TestedExperiment {
  Experiment experiment;
  ExperimentSummary summary;
  std::string error;  ///< why there is no summary; then only the experiment's name is used
};

std::string junitReport(std::span<const TestedExperiment> tested);
std::string junitReport(const Experiment& experiment, const ExperimentSummary& summary);

}  // namespace pitchboard::link
