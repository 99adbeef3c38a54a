// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a curve is highest or lowest. UI thread.

#include <optional>

#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

enum class Extreme { Maximum, Minimum };

/// Returns the time (s) of the first highest or lowest sample of the column in the closed interval;
/// empty if it has none. If only a summary of the rows there is in memory, the time is that of the
/// summary and the rows are being read (GroupView::isReading()): ask again then.
std::optional<double> extremeTime(const telemetry::GroupView& group, std::uint32_t column,
                                  telemetry::TimeRange range, Extreme which);

}  // namespace pitchboard::ui
