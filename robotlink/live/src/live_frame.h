// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes frames of what was heard: a pure function of its arguments. Private to robotlink.

#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

/// Everything but the serial. `time`: seconds since the watch began.
MatchFrame liveFrame(const LiveOptions& options, const telemetry::TeamStatus& team,
                     const telemetry::RefereeTracker& referee, double time);

/// "blue" to Blue; nothing for colours that robots cannot be drawn in.
std::optional<TeamColor> teamColour(std::string_view words);

}  // namespace pitchboard::link
