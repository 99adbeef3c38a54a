// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes frames from received messages: a pure function of its arguments. Private to robotlink.

#include <robotlink/frame/match_frame.h>
#include <robotlink/live/live_options.h>
#include <telemetry/referee/referee_tracker.h>

namespace pitchboard::link {

/// Everything but the serial. `time`: seconds since the watch began.
MatchFrame liveFrame(const LiveOptions& options, const telemetry::TeamStatus& team,
                     const telemetry::RefereeTracker& referee, double time);

}  // namespace pitchboard::link
