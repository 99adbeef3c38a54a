// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes a session of recordings of other programs (telemetry/recordings/recording.h). Every topic
// becomes a group of rows, and what the mapping names becomes robots, log lines and a referee, so
// that a session of it is shown, plotted and exported as one of our own. Runs on the calling
// thread; the session is written on a thread of its own.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <base/file_target.h>
#include <base/result.h>
#include <robotlink/live/topic_mapping.h>

namespace pitchboard::link {

struct ImportOptions {
  std::optional<TopicMapping> mapping;  ///< empty: builtInMapping()
  /// Of all recordings; Auto: what the mapping says of each.
  RecordingClock clock = RecordingClock::Auto;
  /// Each file is a recording of its own, moved so that this happens at the same time in all;
  /// empty: the offsets of the mapping count.
  std::optional<AlignEvent> align;
  IfExists ifExists = IfExists::Refuse;
  std::string program = "pitchboard";  ///< name and version, for the session
};

struct ImportReport {
  std::uint64_t messages = 0;  ///< messages and datagrams that were understood
  std::uint64_t rows = 0;      ///< in the session, also those of robots
  std::uint64_t logLines = 0;
  std::uint64_t events = 0;
  std::uint64_t variables = 0;      ///< columns of all groups
  double seconds = 0.0;             ///< from the first message to the last
  std::vector<std::string> robots;  ///< their names
  std::vector<std::string> notes;   ///< sentences: what was not understood, with counts
  /// Returns one line for people.
  std::string summary() const;
};

/// Returns the mapping that was saved beside a recording: "walk.mapping.json" for "walk.mcap" and
/// for a folder "walk". It need not exist.
std::string mappingBeside(const std::string& recording);

/// Imports files or folders into a new session. Several files of one format are a split recording,
/// but those that the mapping names as recordings of their own, and all with `align`.
/// `progress` is called with 0 to 1; if it returns false, the import stops and nothing is written.
/// Fails as openRecordings(), alignRecordings(), FileTarget and SessionWriter do, and with NotFound
/// if nothing in the recordings is understood.
Result<ImportReport> importRecordings(const std::vector<std::string>& files,
                                      const std::string& output, const ImportOptions& options,
                                      const std::function<bool(double)>& progress = {});

}  // namespace pitchboard::link
