// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Visits every row of a range, wherever rows are kept. One thread at a time.

#include <functional>

#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

using RowVisitor =
    std::function<void(telemetry::GroupId, const telemetry::GroupInfo&, const telemetry::RowView&)>;

/// Visits the rows of all groups in the closed range, in order of time, and at equal times in order
/// of the groups. The view is valid during the call.
void forEachRow(const telemetry::SeriesStore& rows, telemetry::TimeRange range,
                const RowVisitor& visit);
void forEachRow(const telemetry::SessionReader& session, telemetry::TimeRange range,
                const RowVisitor& visit);

/// Visits the row of each group that holds at `time`: its last one at or before it.
void forEachHeldRow(const telemetry::SeriesStore& rows, double time, const RowVisitor& visit);
void forEachHeldRow(const telemetry::SessionReader& session, double time, const RowVisitor& visit);

}  // namespace pitchboard::link
