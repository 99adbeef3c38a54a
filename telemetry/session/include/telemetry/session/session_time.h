// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a time of a session as people type it: seconds of the session, or a date and time of day.
// Pure functions, except that they use the computer's time zone. Any thread.

#include <optional>
#include <string>
#include <string_view>

#include <base/result.h>
#include <telemetry/series/series_types.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// The forms that sessionTime() understands, for --help.
inline constexpr const char* sessionTimeForms =
    "seconds (78.7), m:ss (1:18.7) or h:mm:ss (0:01:18.7) of the session; or a date with a time of "
    "day (2026-11-23 14:03:20; Z at the end: UTC); with --clock a time of day needs no date";

/// Which forms are allowed.
enum class TimeForms {
  Session,  ///< time in the session, or date with time of day
  Clock     ///< a text with a colon is a time of day, with or without date
};

/// Converts a text to seconds of a session. The session was at 0 s at `start`, and its rows and
/// messages fill `range`. A time of day without a date is the first one within `range`, not before
/// `after`; the session may last past midnight. A time up to a second outside becomes the beginning
/// or the end, because people type whole seconds. Fails with InvalidArgument and a sentence with
/// the allowed forms, or with the session's range if the time lies outside.
Result<double> sessionTime(std::string_view text, WallTime start, TimeRange range,
                           TimeForms forms = TimeForms::Session, std::optional<double> after = {});

}  // namespace pitchboard::telemetry
