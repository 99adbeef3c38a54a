// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records a session into a file in a thread of its own (docs/sessions.md has the format). Rows and
// messages go through a bounded queue that counts what it had to drop. What was appended is in
// the file after a second at the latest, also while the disk stalls; a process that is killed loses
// no more. Never overwrites.
// Times are seconds of the source. When the source is put back (an earlier moment is re-entered),
// nothing in the file is lost: what comes after it follows behind what stands there already.

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
  std::size_t queueBytes = std::size_t{64} << 20;  ///< waiting for the disk; beyond it is dropped
  std::size_t chunkBytes = std::size_t{2} << 20;   ///< a chunk is closed when it has these bytes,
  Duration chunkInterval = std::chrono::milliseconds(800);  ///< or this old
  int level = 7;  ///< of zstd; 70 MB/s of rows, a tenth smaller than 3
  bool waitWhenFull =
      false;         ///< append() waits for the disk instead: for runs faster than real time
  bool sync = true;  ///< the disk must have each chunk, not only the kernel
  /// Bytes that the disk has left; empty: the file system is asked. Called on the writing thread.
  std::function<std::optional<std::uint64_t>()> freeSpace;
};

struct SessionStatus {
  bool recording = true;
  /// Why it stopped, for the screen; empty unless something went wrong.
  std::string problem;
  double seconds = 0.0;     ///< of the session so far
  std::uint64_t bytes = 0;  ///< of the file
  std::uint64_t rows = 0;
  std::uint64_t messages = 0;  ///< events, log lines, datagrams, ...
  std::uint64_t dropped = 0;   ///< rows and messages for which the queue had no room
  /// For so long the disk has not answered; the file goes on growing, but not safe from a power
  /// cut.
  double owedSeconds = 0.0;
  std::optional<std::uint64_t> freeBytes;  ///< of the disk, where the system says so
  double bytesPerSecond = 0.0;             ///< of the file lately; 0: not known yet
};

/// Every function may be called from any thread. After a failure append does nothing, and the file
/// holds what was recorded until then.
class SessionWriter : public RowSink {
 public:
  /// Error Conflict when the file exists, SystemError when it cannot be made.
  static Result<std::unique_ptr<SessionWriter>> create(const std::string& path,
                                                       const SessionInfo& info,
                                                       const SessionWriterOptions& options = {});
  /// Goes on in a file whose head was written already (session_copy.h). `path` is only told.
  static std::unique_ptr<SessionWriter> on(McapWriter file, std::string path,
                                           const SessionInfo& info,
                                           const SessionWriterOptions& options);
  ~SessionWriter() override;  ///< as finish()
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;

  /// The same name with the same columns gives the same id again; the attributes stay those of the
  /// first time.
  GroupId addGroup(const GroupInfo& info) override;
  /// Its next rows are in a channel of their own, which says what the group was called before.
  GroupId renameGroup(std::string_view from, const GroupInfo& to) override;
  void append(GroupId group, const RowView& row) override;
  void append(const SessionEvent& event);
  void append(const LogLine& line);
  /// `stream`: Telemetry or RefereeRaw.
  void append(SessionStream stream, const SessionDatagram& datagram);
  /// `json`: an object with the source's seconds as "time".
  void appendJson(SessionStream stream, double time, std::string_view json);
  /// A file beside the rows: the scenario, the catalog, the profile.
  void attach(std::string_view name, std::string_view mediaType, std::string_view data);

  /// What comes from another file, with its own times: a schema, a channel that names it, and
  /// messages of it, byte for byte. With `rows`, the channel holds rows of that group, which get a
  /// summary. Both give the number that it has in this file; 0: there is no more room.
  std::uint16_t addSchema(const McapSchema& schema);
  std::uint16_t addChannel(const McapChannel& channel, const GroupInfo* rows = nullptr);
  /// `row`: what stands in the message, for the summary.
  void append(const McapMessage& message, const RowView* row = nullptr);

  SessionStatus status() const;
  const std::string& path() const;
  /// Writes what waits and the summary; the error is that of status().problem.
  Result<void> finish();

 private:
  struct Impl;
  explicit SessionWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
