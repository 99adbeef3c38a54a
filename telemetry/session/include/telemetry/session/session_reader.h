// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Looks back into a session file: groups as they were recorded, the rows of a moment or of a range,
// events and other messages. Files that broke off, are damaged, come from a later version or from
// another program open as far as they are understood; notes() says what was left out.
// Times are seconds of the session: those of the source, except behind a point where the source was
// put back; there they go on counting (SessionWriter). One thread.

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

/// What has one name is one group, also where columns came in the middle of the recording: rows
/// before them have holes there.
struct SessionGroup {
  GroupInfo info;
  std::uint64_t rows = 0;
  std::uint16_t channel = 0;              ///< with all of its columns
  std::vector<std::uint16_t> channels{};  ///< of the file, in order
};

/// The row that was current at some moment.
struct SessionRow {
  bool present = false;  ///< false: the group had no row yet
  double time = 0.0;
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  RowView view() const { return {time, words, values}; }
};

/// One thing of a session, in the order of recording; valid during the call that hands it out.
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
  /// Errors as McapReader::open().
  static Result<SessionReader> open(const std::string& path, const McapReaderOptions& options = {});
  static Result<SessionReader> openBytes(std::string bytes, const McapReaderOptions& options = {});
  SessionReader(SessionReader&&) noexcept;
  SessionReader& operator=(SessionReader&&) noexcept;
  ~SessionReader();

  const SessionInfo& info() const;
  /// Recorded by Pitchboard; false: another program's file, or the beginning is lost.
  bool ours() const;
  /// False: the recording broke off or its end is damaged; repair makes a whole file of it.
  bool complete() const;
  /// What is wrong or was left out, in sentences; grows when damage is met while reading.
  const std::vector<std::string>& notes() const;
  /// Reads every part that nobody has read yet and compares its checksum: afterwards notes() and
  /// isDamaged() know all damage. `progress` as in walk().
  bool check(const std::function<bool(double)>& progress = {}) const;
  /// A part was met that cannot be read.
  bool isDamaged() const;
  /// The parts of the file that cannot be read, as far as they were met.
  const std::vector<McapLoss>& losses() const;

  /// Index = GroupId.
  std::span<const SessionGroup> groups() const;
  /// From the first row or message to the last.
  std::optional<TimeRange> range() const;
  std::uint64_t count(SessionStream stream) const;

  /// For each group its last row at or before `time`. `out` keeps its memory from call to call.
  void rowsAt(double time, std::vector<SessionRow>& out) const;
  /// Every row of these groups (all when empty) in the closed range, in the order of recording,
  /// until the visitor says false. The view is valid during the call.
  void rows(TimeRange range, std::span<const GroupId> groups,
            const std::function<bool(GroupId, const RowView&)>& visit) const;
  /// The messages of a stream in the closed range, with their time, until the visitor says false.
  void messages(SessionStream stream, TimeRange range,
                const std::function<bool(double time, std::string_view json)>& visit) const;
  /// The same of several streams, in the order of recording.
  void messages(
      std::span<const SessionStream> streams, TimeRange range,
      const std::function<bool(SessionStream, double time, std::string_view json)>& visit) const;
  /// Long sessions hold a coarse picture of their rows. In a recording that broke off its end is
  /// missing: summary() makes it from the rows, which takes as long as reading them, once.
  bool hasSummaries() const;
  /// Of one group; empty when there is none, or `goOn` says false.
  GroupSummary summary(GroupId group, const std::function<bool()>& goOn = {}) const;
  /// Everything that is known in the closed range; `progress` gets the part that is done (0 to 1)
  /// now and then. Ends when one of them says false.
  bool walk(TimeRange range, const std::function<bool(const SessionItem&)>& visit,
            const std::function<bool(double)>& progress = {}) const;
  /// The same with rows only.
  bool walkRows(TimeRange range, const std::function<bool(const SessionItem&)>& visit,
                const std::function<bool(double)>& progress = {}) const;
  /// Every message in the closed range as it stands in the file, also of channels that nobody here
  /// knows. A range from −1e18 to 1e18 holds those whose times cannot be right, too.
  bool walkFile(TimeRange range, const std::function<bool(const McapMessage&)>& visit,
                const std::function<bool(double)>& progress = {}) const;
  /// All events; those that are not of the form of an event are left out.
  std::vector<SessionEvent> events() const;

  /// Error NotFound, or ParseError when it is damaged.
  Result<std::string> attachment(std::string_view name) const;

  const McapReader& file() const;
  /// The session's time of a message, and the file's time of a moment (ns since 1970).
  double seconds(std::uint64_t logTime) const;
  std::uint64_t logTime(double seconds) const;

 private:
  struct Impl;
  static Result<SessionReader> of(Result<McapReader> file);
  explicit SessionReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

/// A message of the streams Log, and Telemetry or RefereeRaw. Nothing when it is not of that form.
std::optional<LogLine> sessionLogLine(std::string_view json);
std::optional<SessionDatagram> sessionDatagram(std::string_view json);
/// As it stands in a file.
std::string sessionEventJson(const SessionEvent& event);

}  // namespace pitchboard::telemetry
