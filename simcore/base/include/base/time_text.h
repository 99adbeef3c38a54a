// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Times and lengths of time as people type them: the one parser of command line and studio, and
// the writer that fits it. Pure functions, any thread; seconds.

#include <optional>
#include <string>
#include <string_view>

namespace pitchboard {

/// What secondsFromText() reads, for --help and errors.
inline constexpr const char* timeForms = "seconds (78.7), m:ss (1:18.7) or h:mm:ss (0:01:18.7)";

/// The seconds of "78.7", "1:18.7" or "0:01:18.7"; a minus sign in front (- or −) is understood.
/// Exactly two digits, at most 59, follow a colon. Empty for any other text.
std::optional<double> secondsFromText(std::string_view text);

/// "0:05", "1:18.7", "1:02:03.25": what secondsFromText() reads, rounded to milliseconds. "–" if
/// `seconds` is not finite.
std::string secondsToText(double seconds);

}  // namespace pitchboard
