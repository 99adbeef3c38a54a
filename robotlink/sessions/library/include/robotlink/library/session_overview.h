// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a list of recordings shows of one. It is made from the file's header and index, its events,
// its last moment and the notes beside it; rows are not read otherwise, so that a long recording
// takes little longer than a short one. Plain values and pure functions; any thread.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

struct SessionOverview {
  bool isReadable = false;         ///< false: the rest is unknown, and `problem` says why
  std::string problem;             ///< a sentence; also of a file that is read in part
  telemetry::WallTime created{};   ///< when recording began; 0: unknown
  std::string source;              ///< "simulation" or "live"
  std::string title;               ///< of the match
  double length = 0.0;             ///< s
  std::vector<std::string> teams;  ///< names, or colours; with a score, the left team is first
  std::optional<std::pair<int, int>> score{};  ///< left and right team, at the end
  std::vector<std::string> robots;             ///< names, in the order of lists
  std::uint64_t events = 0;                    ///< that count, without bookmarks
  std::uint64_t bookmarks = 0;
  std::vector<std::string> notes;  ///< texts of bookmarks; at most 4 kB, the rest is left out
  double telling = 0.0;            ///< s of the session: a moment for a picture
  bool operator==(const SessionOverview&) const = default;
};

/// Reads the overview of a file. `goOn` is asked from time to time; after false the overview is
/// not readable.
SessionOverview overviewOf(const std::string& path, const std::function<bool()>& goOn = {});

/// Returns an overview as a JSON object in one line, without the path.
std::string overviewJson(const SessionOverview& overview);
/// Reads it again, its date to a microsecond; nothing if it is damaged.
std::optional<SessionOverview> overviewFromJson(std::string_view json);

/// Returns "RoboFEI – Guests"; empty if no team is known.
std::string teamsText(const SessionOverview& overview);
/// Returns "3 : 1"; empty if the score is unknown.
std::string scoreText(const SessionOverview& overview);

}  // namespace pitchboard::link
