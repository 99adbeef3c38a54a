// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The texts of a finished experiment's files. Pure: the same results give the same bytes.

#include <string>

#include <robotlink/experiment/experiment_summary.h>

namespace pitchboard::link {

std::string csvHead(const std::vector<MetricInfo>& metrics);
std::string csvLine(const Experiment& experiment, const RunResult& result);
std::string summaryJson(const Experiment& experiment, const ExperimentSummary& summary);
std::string reportMarkdown(const Experiment& experiment, const ExperimentSummary& summary);
/// A page that needs nothing but itself.
std::string experimentReportHtml(const Experiment& experiment, const ResultTable& table,
                                 const ExperimentSummary& summary);

}  // namespace pitchboard::link
