// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a condition may hold, by the summaries of minimum and maximum that long sessions contain.
// Private to the library; one thread.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <telemetry/query/session_query.h>

namespace pitchboard::telemetry {

/// Returns closed ranges in order of time that contain every sample at which a curve of the query
/// can be true, and the sample after each; nothing if the session's summaries rule nothing out.
/// `conditions` are the texts of the query, by QueryCurve::value.
std::optional<std::vector<TimeRange>> possibleTimes(const SessionReader& session,
                                                    const SessionQuery& query,
                                                    std::span<const std::string> conditions,
                                                    const std::function<bool()>& goOn);

}  // namespace pitchboard::telemetry
