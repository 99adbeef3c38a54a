// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How the coarse picture of a group's rows stands in a session file (docs/file-formats.md,
// Summaries). Private to the library. Little-endian.

#include <optional>
#include <string>
#include <string_view>

#include <telemetry/series/series_summary.h>

namespace pitchboard::telemetry::session {

inline constexpr std::string_view summaryKey =
    "pitchboard.summary";  ///< metadata: the group's topic
inline constexpr std::string_view summaryEncoding = "x-pitchboard-summary";

std::string summaryBytes(const SummaryPart& part);
/// Nothing for bytes that are no part of at most so many columns; those that it does not have (they
/// came later) are holes.
std::optional<SummaryPart> summaryFromBytes(std::string_view bytes, std::size_t most);

}  // namespace pitchboard::telemetry::session
