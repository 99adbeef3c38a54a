// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a session file: groups, the rows of a moment or a range, events and other messages. Files
// that are truncated, damaged, from a later version or from another program open as far as they are
// understood; notes() says what was left out. Times are seconds of the session: those of the
// source, except that they keep increasing where the source was put back (SessionWriter). Rows and
// messages are visited in the order of their times (those of equal times in the order of the file),
// whatever order another program gave them. Chunks that overlap in time are in memory together, up
// to 256 MiB; beyond that they are read several times. One thread at a time.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/series/series_summary.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::telemetry {

/// A group of the session. It is one group even if its columns changed during the recording; rows
/// that do not have a column have a gap there (mergedColumns() in column_merge.h).
struct SessionGroup {
  GroupInfo info;
  std::uint64_t rows = 0;
  std::vector<std::uint16_t> channels{};  ///< of the file, in order
};

/// The row of a group that was current at some moment.
struct SessionRow {
  bool present = false;  ///< false if the group had no row yet
  double time = 0.0;
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  std::uint16_t channel = 0;  ///< of the file
  RowView view() const { return {time, words, values}; }
};

/// A row or message of a session. Valid only during the call that passes it.
struct SessionItem {
  double time = 0.0;
  const McapMessage* message = nullptr;
  bool isRow = false;
  GroupId group = 0;                             ///< with isRow
  RowView row;                                   ///< with isRow
  SessionStream stream = SessionStream::Events;  ///< otherwise; message->data is its JSON
};

class SessionReader {
 public:
  /// Opens a file, and the notes beside it (session_notes.h). Fails as McapReader::open() does.
  static Result<SessionReader> open(const std::string& path, const McapReaderOptions& options = {});
  static Result<SessionReader> openBytes(std::string bytes, const McapReaderOptions& options = {});
  SessionReader(SessionReader&&) noexcept;
  SessionReader& operator=(SessionReader&&) noexcept;
  ~SessionReader();

  const SessionInfo& info() const;
  /// Returns false if another program wrote the file, or if its beginning is lost.
  bool ours() const;
  /// Returns true if another program wrote the file and nothing in it has Pitchboard's format.
  bool isForeign() const;
  /// Returns false if the recording was cut off, if its end is damaged, or while it isGrowing().
  bool complete() const;
  /// Returns true if the file was still being recorded when it was opened. What was written by then
  /// is shown.
  bool isGrowing() const;
  /// Returns the channels of the file that are not in Pitchboard's format.
  std::span<const std::uint16_t> otherChannels() const;
  /// Returns sentences that say what is wrong or was left out. More can come while reading.
  const std::vector<std::string>& notes() const;
  /// Reads every part that was not read yet and checks it, so that notes() and isDamaged() know all
  /// damage. `progress` as in walk().
  bool check(const std::function<bool(double)>& progress = {}) const;
  /// Returns whether a damaged part was found.
  bool isDamaged() const;
  /// Returns the parts that cannot be read, as far as they were found.
  const std::vector<McapLoss>& losses() const;

  /// Returns the groups; the index is the GroupId.
  std::span<const SessionGroup> groups() const;
  /// Returns the groups that a typed name means (robot_names.h); fails with the names there are.
  Result<std::vector<GroupId>> groupsNamed(std::string_view name) const;
  /// Returns the times of the first and the last row or message.
  std::optional<TimeRange> range() const;
  std::uint64_t count(SessionStream stream) const;

  /// Reads the last row of each group at or before `time`. The memory of `out` is reused.
  void rowsAt(double time, std::vector<SessionRow>& out) const;
  /// Visits the rows of these groups (all if empty) in the closed range until `visit` returns
  /// false. The view is valid during the call.
  void rows(TimeRange range, std::span<const GroupId> groups,
            const std::function<bool(GroupId, const RowView&)>& visit) const;
  /// Visits the messages of a stream in the closed range until `visit` returns false.
  void messages(SessionStream stream, TimeRange range,
                const std::function<bool(double time, std::string_view json)>& visit) const;
  /// The same for several streams.
  void messages(
      std::span<const SessionStream> streams, TimeRange range,
      const std::function<bool(SessionStream, double time, std::string_view json)>& visit) const;
  /// Returns whether the file has summaries, as long sessions do. If the recording was cut off, the
  /// last part is missing; summary() then computes it once, which takes as long as reading the
  /// rows.
  bool hasSummaries() const;
  /// Returns the summary of a group; empty if there is none or `goOn` returns false.
  GroupSummary summary(GroupId group, const std::function<bool()>& goOn = {}) const;
  /// Visits all rows and messages in the closed range. `progress` is called from time to time with
  /// the share that is done (0 to 1). Stops when one of them returns false, and then returns false.
  bool walk(TimeRange range, const std::function<bool(const SessionItem&)>& visit,
            const std::function<bool(double)>& progress = {}) const;
  /// The same for rows only.
  bool walkRows(TimeRange range, const std::function<bool(const SessionItem&)>& visit,
                const std::function<bool(double)>& progress = {}) const;
  /// Visits every message in the closed range as it is in the file, also of unknown channels.
  /// The range from −1e18 to 1e18 includes messages with impossible times.
  bool walkFile(TimeRange range, const std::function<bool(const McapMessage&)>& visit,
                const std::function<bool(double)>& progress = {}) const;
  /// Returns all valid events in order of time, with the bookmarks of the notes beside the file. Of
  /// bookmarks at the same time only the last counts: it is the one with the note.
  std::vector<SessionEvent> events() const;
  /// Returns the bookmarks of the notes beside the file, in order of time.
  const std::vector<SessionEvent>& addedNotes() const;

  /// Reads an attachment. Fails with NotFound, or with ParseError if it is damaged.
  Result<std::string> attachment(std::string_view name) const;

  const McapReader& file() const;
  /// Converts between the file's log time (ns since 1970) and seconds of the session.
  double seconds(std::uint64_t logTime) const;
  std::uint64_t logTime(double seconds) const;

 private:
  struct Impl;
  static Result<SessionReader> of(Result<McapReader> file);
  explicit SessionReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

/// Reads a message of the stream Log, or of Telemetry and RefereeRaw. Nothing if it is not valid.
std::optional<LogLine> sessionLogLine(std::string_view json);
std::optional<SessionDatagram> sessionDatagram(std::string_view json);
/// Returns an event as JSON, as it is in a file.
std::string sessionEventJson(const SessionEvent& event);

}  // namespace pitchboard::telemetry
