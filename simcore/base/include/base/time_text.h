// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and writes times and durations as people type them, on the command line and in the studio.
// Seconds; pure functions; any thread.

#include <optional>
#include <string>
#include <string_view>

namespace pitchboard {

/// The forms that secondsFromText() reads, for --help and errors.
inline constexpr const char* timeForms = "seconds (78.7), m:ss (1:18.7) or h:mm:ss (0:01:18.7)";

/// Returns the seconds of "78.7", "1:18.7" or "0:01:18.7", also with a minus sign in front (- or
/// −). After a colon there must be exactly two digits, at most 59. Nothing for any other text.
std::optional<double> secondsFromText(std::string_view text);

/// Returns a text that secondsFromText() reads, rounded to milliseconds: "0:05", "1:18.7". Returns
/// "–" if `seconds` is not finite.
std::string secondsToText(double seconds);

}  // namespace pitchboard
