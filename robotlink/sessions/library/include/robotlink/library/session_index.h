// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Remembers the overviews of recordings in a file, so that a list of them appears without opening
// each. An overview holds as long as the recording and the notes beside it are the same files: by
// path, size and time of change. One JSON object per line; a line that is damaged is left out, and
// the recording is read again. Pure functions; any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/library/session_overview.h>

namespace pitchboard::link {

/// Which version of a recording it is. Times are nanoseconds since 1970; 0: there is no such file.
struct RecordingStamp {
  std::uint64_t bytes = 0;
  std::int64_t changed = 0, notesChanged = 0;
  bool operator==(const RecordingStamp&) const = default;
};
/// Returns nothing if the file is gone.
std::optional<RecordingStamp> stampOf(const std::string& path);

struct IndexedSession {
  std::string path;
  RecordingStamp stamp;
  SessionOverview overview;
  bool operator==(const IndexedSession&) const = default;
};

/// Returns what is intact in the index; nothing if there is no such file, or if it is of another
/// version.
std::vector<IndexedSession> readSessionIndex(const std::string& path);
/// Replaces the index. Its folder must exist. Fails as writeFile().
Result<void> writeSessionIndex(const std::string& path, std::span<const IndexedSession> sessions);

}  // namespace pitchboard::link
