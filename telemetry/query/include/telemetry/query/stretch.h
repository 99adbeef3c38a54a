// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the samples of a stretch of a session or of memory: some ranges of time, or while a
// condition holds. What is read is kept in memory: 16 bytes for each sample. One thread at a time.
// Times are seconds of the session.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/query/session_query.h>
#include <telemetry/statistics/curve_statistics.h>

namespace pitchboard::telemetry {

struct StretchCurve {
  QueryCurve curve;
  std::vector<Sample> samples;  ///< from the first range to the last; NaN where they do not count
  Counted counted;              ///< which of them are in a range, while the condition holds
};

/// Reads the curves of `texts` in closed ranges, which are in order of time. `progress` is called
/// from time to time with the share that is done (0 to 1). Fails as SessionQuery::of(), and with
/// Conflict after `progress` returned false.
Result<std::vector<StretchCurve>> readStretch(const QueryRows& rows, const QueryTexts& texts,
                                              std::span<const TimeRange> ranges,
                                              const std::function<bool(double)>& progress = {});

/// Returns the ranges from each event `first` to the next event `last`, each a kind or
/// `kind:detail`; if it does not come, to `end` (s). `events` are in order of time. Fails with
/// NotFound and the kinds that there are.
Result<std::vector<TimeRange>> rangesBetween(std::span<const SessionEvent> events,
                                             std::optional<double> end, const std::string& first,
                                             const std::string& last);
/// The same for the events of a session and its end.
Result<std::vector<TimeRange>> rangesBetween(const SessionReader& session, const std::string& first,
                                             const std::string& last);

}  // namespace pitchboard::telemetry
