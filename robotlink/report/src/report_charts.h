// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The small curves of the report, as inline SVG. Private to robotlink.

#include <string>
#include <vector>

#include <robotlink/report/report_page.h>
#include <robotlink/report/session_statistics.h>

namespace pitchboard::link {

/// "1:02:05", "12:05", "0:07".
std::string clockText(double seconds);

/// A curve over the time of the report; `most` is the top of the axis. NaN parts are gaps.
std::string curveChart(const std::vector<double>& values, double most, const std::string& unit,
                       telemetry::TimeRange range);
/// Shares from 0 to 1, a bar for each part.
std::string shareChart(const std::vector<double>& shares, telemetry::TimeRange range);
/// A round number at or above `value`, for the top of an axis.
double axisTop(double value);

}  // namespace pitchboard::link
