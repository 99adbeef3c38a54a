// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes durations in seconds as text for people. Used for reports, the command line and the
// screen. Pure function; any thread.

#include <string>

namespace pitchboard {

/// Returns a duration in seconds as "12 s", "32 min 17 s", "5 h 4 min" or "3 d 4 h", rounded down.
/// `decimals` are used below ten seconds: "0.2 s". Returns "–" if the duration is not finite.
std::string durationText(double seconds, int decimals = 0);

}  // namespace pitchboard
