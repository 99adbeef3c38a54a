// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A session, or part of it, as a new file: clips and repaired files are written here. Messages keep
// their bytes and times, also those of channels that nobody here knows; summaries are made again.
// Private to the library. One thread, beside that of the SessionWriter.

#include <map>

#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_export.h>

namespace pitchboard::telemetry {

/// What went into a channel, or came out of it: must be the same.
struct ChannelDigest {
  std::uint64_t messages = 0;
  std::uint32_t crc = 0;
  void add(const McapMessage& message);
  bool operator==(const ChannelDigest&) const = default;
};

struct CopyReport {
  std::map<std::uint16_t, ChannelDigest> channels;  ///< of the new file, without summaries
  std::uint64_t bytes = 0;
  std::uint64_t messagesWithoutChannel = 0;  ///< messages of channels whose description is lost
  std::vector<std::string> missing;  ///< what is no message and cannot be read, in sentences
};

/// Into a file that was begun, which it finishes. Progress and errors as exportFile(). Without
/// `withDigests` messages are only counted, which takes a fifth less time.
Result<CopyReport> copySession(const SessionReader& session, const ExportSelection& selection,
                               NewFile file, const McapWriterOptions& options,
                               const std::function<bool(double)>& progress, bool withDigests);

tl::unexpected<Error> exportStopped();

}  // namespace pitchboard::telemetry
