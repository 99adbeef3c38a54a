// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The statistics of a live match, from the frames that were seen: whatever a team's profile calls
// things, a frame has places in metres, the battery, the penalties. Private to the library.

#include <robotlink/report/session_statistics.h>

namespace pitchboard::link {

/// m; believed places tremble by less.
inline constexpr double leastMove = 0.1;

/// An action's code that lets control kick.
bool isKick(int code);

SessionStatistics liveStatistics(const telemetry::SessionReader& session,
                                 telemetry::TimeRange range);

}  // namespace pitchboard::link
