// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A moment of a session as people type it: seconds of the session, or a time of day. A pure
// function but for the computer's time zone.

#include <optional>
#include <string>
#include <string_view>

#include <base/result.h>
#include <telemetry/series/series_types.h>
#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// What sessionTime() understands, for --help.
inline constexpr const char* sessionTimeForms =
    "seconds (78.7), m:ss (1:18.7) or h:mm:ss (0:01:18.7) of the session; or a date with a time of "
    "day (2026-11-23 14:03:20; Z at the end: UTC); with --clock a time of day needs no date";

/// How a moment was typed.
enum class TimeForms {
  Session,  ///< in the session's time, or as a date with a time of day
  Clock     ///< a time of day needs no date; a text with a colon is always one
};

/// Seconds of a session that was at 0 s at `start`, whose rows and messages fill `range`. A time of
/// day without a date is the first one within `range` (not before `after`), which may go on behind
/// midnight, or the one that is nearest to it. Error InvalidArgument with a sentence that says what
/// can be written, or that gives the session's range: a moment more than a second outside is
/// refused; closer ones (people type whole seconds) become the beginning or the end.
Result<double> sessionTime(std::string_view text, WallTime start, TimeRange range,
                           TimeForms forms = TimeForms::Session, std::optional<double> after = {});

}  // namespace pitchboard::telemetry
