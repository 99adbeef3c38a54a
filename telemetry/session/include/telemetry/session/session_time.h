// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A moment of a session as people type it: seconds of the session, or a time of day. A pure
// function but for the computer's time zone.

#include <string>
#include <string_view>

#include <base/result.h>
#include <telemetry/series/series_types.h>
#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// What sessionTime() understands, for --help.
inline constexpr const char* sessionTimeForms =
    "seconds of the session, or a time of day: 14:03:20 by this computer's clock, 13:03:20Z in "
    "UTC, "
    "also with its day, 2026-11-22T14:03:20";

/// Seconds of a session that was at 0 s at `start`. A time of day without a day is the first one
/// within `range`, which may go on behind midnight, or else the one that is nearest to it. Error
/// InvalidArgument with a sentence that says what can be written.
Result<double> sessionTime(std::string_view text, WallTime start, TimeRange range);

}  // namespace pitchboard::telemetry
