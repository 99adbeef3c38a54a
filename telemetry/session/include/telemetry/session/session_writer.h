// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records a session into a file (docs/file-formats.md describes the format) on a thread of its own.
// Rows and messages go through a bounded queue, which counts what it had to drop. Whatever was
// appended is in the file within a second, even while the disk stalls, so a killed process loses no
// more than that. Existing files are never overwritten.
// Times are seconds of the source. If the source is put back to an earlier moment, the file keeps
// what it has, and new rows follow behind.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <base/result.h>
#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/series/row_sink.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::telemetry {

struct SessionWriterOptions {
  std::size_t queueBytes = std::size_t{64}
                           << 20;  ///< bytes that may wait for the disk; more is dropped
  std::size_t chunkBytes = std::size_t{2} << 20;            ///< a chunk is written at this size,
  Duration chunkInterval = std::chrono::milliseconds(800);  ///< or at this age
  int level = 7;  ///< as of McapWriterOptions; 7 is a tenth smaller than 3
  bool waitWhenFull =
      false;             ///< append() waits instead of dropping, for runs faster than real time
  bool sync = true;      ///< flush each chunk to the disk, not only to the kernel
  bool replace = false;  ///< an existing file, unless it is still being recorded
  /// Returns the free bytes of the disk; if it is empty, the file system is asked. Called on the
  /// writing thread.
  std::function<std::optional<std::uint64_t>()> freeSpace;
};

struct SessionStatus {
  bool recording = true;
  /// A sentence that says why recording stopped; empty if nothing went wrong.
  std::string problem;
  double seconds = 0.0;     ///< length of the session so far
  std::uint64_t bytes = 0;  ///< size of the file
  std::uint64_t rows = 0;
  std::uint64_t messages = 0;  ///< events, log lines, datagrams, ...
  std::uint64_t dropped = 0;   ///< rows and messages for which the queue had no room
  /// For how long the current flush has taken, in s. The file keeps growing meanwhile, but a power
  /// failure would lose what was not flushed.
  double syncLatency = 0.0;
  std::optional<std::uint64_t> freeBytes;  ///< free space of the disk, if known
  double bytesPerSecond = 0.0;             ///< recent growth of the file; 0 if not known yet
};

/// Every function may be called from any thread. After a failure append() does nothing, and the
/// file holds what was recorded until then.
class SessionWriter : public RowSink {
 public:
  /// Creates the file. Fails with Conflict if it exists, with SystemError if it cannot be created.
  static Result<std::unique_ptr<SessionWriter>> create(const std::string& path,
                                                       const SessionInfo& info,
                                                       const SessionWriterOptions& options = {});
  /// Continues a file whose header was already written (session_copy.h). `path` is only reported.
  static std::unique_ptr<SessionWriter> on(McapWriter file, std::string path,
                                           const SessionInfo& info,
                                           const SessionWriterOptions& options);
  ~SessionWriter() override;  ///< calls finish()
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;

  /// Registers a group; the same group (isSameGroup()) has the same id. Another name and other
  /// facts are written beside the rows, which stay in their channel; a group without
  /// GroupInfo::id keeps its first ones. Rows with other columns go into another channel. While
  /// columns keep coming, rows wait in memory for up to 8 s, so that there need not be a channel
  /// for each of them; new labels are written from time to time, and by finish().
  GroupId addGroup(const GroupInfo& info) override;
  void append(GroupId group, const RowView& row) override;
  void append(const SessionEvent& event);
  void append(const LogLine& line);
  /// Records a datagram; `stream` is Telemetry or RefereeRaw.
  void append(SessionStream stream, const SessionDatagram& datagram);
  /// Records a message; `json` is an object whose "time" is in seconds of the source.
  void appendJson(SessionStream stream, double time, std::string_view json);
  /// Attaches a file, such as the scenario, the catalog or the profile.
  void attach(std::string_view name, std::string_view mediaType, std::string_view data);

  /// Copy schemas, channels and messages of another file byte for byte, with their own times. With
  /// `rows`, the channel holds rows of that group, which get a summary. Both return the id in this
  /// file, or 0 if there are too many.
  std::uint16_t addSchema(const McapSchema& schema);
  std::uint16_t addChannel(const McapChannel& channel, const GroupInfo* rows = nullptr);
  /// Copies a message; `row` is its content, for the summary.
  void append(const McapMessage& message, const RowView* row = nullptr);

  SessionStatus status() const;
  const std::string& path() const;
  /// Writes what is still queued, and the summary. Fails with the reason in status().problem.
  Result<void> finish();

 private:
  struct Impl;
  explicit SessionWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
