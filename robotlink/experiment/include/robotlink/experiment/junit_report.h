// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Assertions as JUnit XML, which continuous integration reads: a test suite for each condition of
// an experiment, a test for each of its assertions. Pure; any thread.

#include <span>
#include <string>

#include <robotlink/experiment/experiment_summary.h>

namespace pitchboard::link {

struct TestedExperiment {
  Experiment experiment;
  ExperimentSummary summary;
};

std::string junitReport(std::span<const TestedExperiment> tested);
std::string junitReport(const Experiment& experiment, const ExperimentSummary& summary);

}  // namespace pitchboard::link
