// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a robot was before a moment, from the rows of its source: the trail of a moment is the same
// however somebody came to it. UI thread only.

#include <vector>

#include <robotlink/frame/robot_frame.h>
#include <simcore/world/field.h>
#include <telemetry/series/series_store.h>

#include "trail_item.h"

namespace pitchboard::ui {

/// Returns where a robot truly was, or believed to be where nobody knows the truth, ten times a
/// second, up to `time` (s). Empty while the rows are being read, and for robots of Live whose
/// profile gives their position a name of its own.
std::vector<TrailItem::Place> trailOf(const telemetry::SeriesStore& rows,
                                      const link::RobotFrame& robot, const sim::FieldSpec& field,
                                      double time);

}  // namespace pitchboard::ui
