// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a robot was before a moment, from the rows of its source: the trail of a moment is the same
// however somebody came to it. UI thread only.

#include <vector>

#include <robotlink/frame/robot_frame.h>
#include <telemetry/series/series_store.h>

#include "trail_item.h"

namespace pitchboard::ui {

/// The true places of a simulated robot, ten a second, up to `time` (s). Empty for robots of Live,
/// whose rows are written as their profile says, and while the rows are being read.
std::vector<TrailItem::Place> trailOf(const telemetry::SeriesStore& rows,
                                      const link::RobotFrame& robot, double time);

}  // namespace pitchboard::ui
