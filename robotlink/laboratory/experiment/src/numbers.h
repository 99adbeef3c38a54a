// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers of reports as text: four significant digits, and whole ones in full. Pure.

#include <string>

#include <robotlink/experiment/run_result.h>
#include <robotlink/experiment/statistics.h>

namespace pitchboard::link {

/// "0.4312", "848.4", "12"; "–" for NaN.
std::string number(double value);
/// The value of a metric: a rate in percent.
std::string valueText(const MetricInfo& metric, double value);
/// "[0.41, 0.45]".
std::string intervalText(const MetricInfo& metric, const std::optional<Interval>& interval);
/// "Distance walked, m".
std::string titleOf(const MetricInfo& metric);
/// "0.031", "< 0.001".
std::string probabilityText(double p);

}  // namespace pitchboard::link
