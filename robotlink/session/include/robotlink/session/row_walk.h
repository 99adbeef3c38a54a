// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Walks through every row of a range, wherever rows are kept.

#include <functional>

#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

using RowVisitor =
    std::function<void(telemetry::GroupId, const telemetry::GroupInfo&, const telemetry::RowView&)>;

/// Rows of all groups in the closed range, in order of time; rows of one time in order of the
/// groups. The view is valid during the call.
void forEachRow(const telemetry::SeriesStore& rows, telemetry::TimeRange range,
                const RowVisitor& visit);
void forEachRow(const telemetry::SessionReader& session, telemetry::TimeRange range,
                const RowVisitor& visit);

}  // namespace pitchboard::link
