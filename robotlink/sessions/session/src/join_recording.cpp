// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/join_recording.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <utility>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/session/row_slot.h>
#include <telemetry/session/session_writer.h>

namespace pitchboard::link {
namespace {

constexpr double readAtOnce = 1.0;  // s of the recording that are in memory

bool isBoard(const telemetry::GroupInfo& group) {
  const telemetry::RobotFacts& facts = factsOf(group);
  return facts.linkOf.empty() && (facts.attached || !facts.sentFrom.empty());
}

Result<telemetry::GroupId> recordedGroup(const telemetry::SessionReader& recording) {
  const auto groups = recording.groups();
  for (telemetry::GroupId id = 0; id < groups.size(); ++id) {
    if (isBoard(groups[id].info)) return id;
  }
  return failure(ErrorCode::NotFound,
                 "This is not the recording of a robot by pitchboard-agent --record: it has no "
                 "blackboard.");
}

Result<telemetry::GroupId> robotOfSession(const telemetry::SessionReader& session,
                                          const telemetry::GroupInfo& recorded,
                                          const std::string& name) {
  std::string names;
  const auto groups = session.groups();
  for (telemetry::GroupId id = 0; id < groups.size(); ++id) {
    const telemetry::GroupInfo& group = groups[id].info;
    if (!isBoard(group)) continue;
    const bool isIt =
        name.empty() ? factsOf(group).slot == factsOf(recorded).slot : name == group.name;
    if (isIt) return id;
    names += (names.empty() ? "" : ", ") + group.name;
  }
  const std::string robot = name.empty() ? recorded.name : name;
  return failure(ErrorCode::NotFound,
                 names.empty()
                     ? "The session has no blackboard that a robot sent, so there is nothing to "
                       "join to. Record it with pitchboard-agent running on the robot."
                     : "The session has no blackboard of " + robot +
                           ". Name the robot with "
                           "--robot: " +
                           names + ".");
}

/// Writes a session in which the rows of one robot are replaced while its own recording has rows.
class Joiner {
 public:
  Joiner(const telemetry::SessionReader& session, telemetry::GroupId robot,
         const telemetry::SessionReader& recording, telemetry::GroupId recorded,
         const ClockFit& clock, telemetry::SessionWriter& writer)
      : m_session(session),
        m_robot(robot),
        m_recording(recording),
        m_recorded(recorded),
        m_clock(clock),
        m_writer(writer) {
    for (const telemetry::SessionGroup& group : session.groups()) {
      m_ids.push_back(writer.addGroup(group.info));
    }
    m_range = *recording.range();
    m_next = m_range.begin;
    mergeColumns();
  }

  /// Returns false if `progress` did.
  bool run(JoinReport& report, const std::function<bool(double)>& progress) {
    const bool done = m_session.walk(
        {-1e18, 1e18},
        [&](const telemetry::SessionItem& item) {
          takeRecorded(item.time);
          if (!item.isRow) {
            m_writer.appendJson(item.stream, item.time, item.message->data);
          } else if (item.group != m_robot || !isCovered(item.time)) {
            m_writer.append(m_ids[item.group], item.row);
          } else {
            m_held.words.assign(item.row.words.begin(), item.row.words.end());
            m_held.values.assign(item.row.values.begin(), item.row.values.end());
            m_held.present = true;
            ++report.replaced;
          }
          return true;
        },
        [&](double part) { return !progress || progress(part); });
    takeRecorded(std::numeric_limits<double>::infinity());
    report.rows = m_rows;
    return done;
  }

 private:
  /// All columns of the recording, then those that only the session has.
  void mergeColumns() {
    const telemetry::GroupInfo& here = m_session.groups()[m_robot].info;
    const telemetry::GroupInfo& there = m_recording.groups()[m_recorded].info;
    telemetry::GroupInfo both = here;
    both.columns.clear();
    for (const bool words : {true, false}) {
      const auto take = [&](const telemetry::GroupInfo& from, bool recorded) {
        for (const telemetry::ColumnInfo& column : from.columns) {
          const bool isWord = column.type != telemetry::ColumnType::Float64;
          if (isWord != words || (!recorded && findSlot(there, {column.name}).present())) continue;
          both.columns.push_back(column);
          m_places.push_back({recorded, findSlot(from, {column.name})});
        }
      };
      take(there, true);
      take(here, false);
    }
    m_joined = m_writer.addGroup(both);
  }

  bool isCovered(double time) const {
    return time >= m_clock.toSession(m_range.begin) && time <= m_clock.toSession(m_range.end);
  }

  /// Writes the recorded rows until this time of the session.
  void takeRecorded(double until) {
    for (;;) {
      for (; m_taken < m_block.size(); ++m_taken) {
        if (m_clock.toSession(m_block[m_taken].time) > until) return;
        write(m_block[m_taken]);
      }
      if (m_next > m_range.end || m_clock.toSession(m_next) > until) return;
      readBlock();
    }
  }

  void readBlock() {
    m_block.clear();
    m_taken = 0;
    const double begin = std::exchange(m_next, m_next + readAtOnce);
    const std::array<telemetry::GroupId, 1> only{m_recorded};
    m_recording.rows({begin, m_next}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
      // The last moment belongs to the next block.
      if (row.time >= m_next) return false;
      telemetry::SessionRow& kept = m_block.emplace_back();
      kept.time = row.time;
      kept.words.assign(row.words.begin(), row.words.end());
      kept.values.assign(row.values.begin(), row.values.end());
      return true;
    });
  }

  void write(const telemetry::SessionRow& recorded) {
    m_words.clear();
    m_values.clear();
    for (const auto& [fromRecording, slot] : m_places) {
      const telemetry::SessionRow& row = fromRecording ? recorded : m_held;
      const auto at = static_cast<std::size_t>(slot.index);
      if (slot.type == telemetry::ColumnType::Float64) {
        m_values.push_back(at < row.values.size() ? row.values[at]
                                                  : std::numeric_limits<double>::quiet_NaN());
      } else {
        m_words.push_back(at < row.words.size() ? row.words[at] : 0U);
      }
    }
    m_writer.append(m_joined, {m_clock.toSession(recorded.time), m_words, m_values});
    ++m_rows;
  }

  const telemetry::SessionReader& m_session;
  const telemetry::GroupId m_robot;
  const telemetry::SessionReader& m_recording;
  const telemetry::GroupId m_recorded;
  const ClockFit m_clock;
  telemetry::SessionWriter& m_writer;
  std::vector<telemetry::GroupId> m_ids;  // in the new file, of the session's groups
  telemetry::GroupId m_joined = 0;
  std::vector<std::pair<bool, RowSlot>> m_places;  // of the joined columns: of the recording?
  telemetry::TimeRange m_range;                    // of the recording
  std::vector<telemetry::SessionRow> m_block;
  std::size_t m_taken = 0;       // rows of the block
  double m_next = 0.0;           // where the next block begins
  telemetry::SessionRow m_held;  // the newest row of the session
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_values;
  std::uint64_t m_rows = 0;
};

Result<void> copyAttachments(const telemetry::SessionReader& from, telemetry::SessionWriter& to) {
  for (const telemetry::McapAttachmentInfo& entry : from.file().contents().attachments) {
    const auto data = TRY(from.file().readAttachment(entry));
    to.attach(entry.name, entry.mediaType, data);
  }
  return {};
}

}  // namespace

std::string JoinReport::summary() const {
  char text[240];
  std::snprintf(text, sizeof text,
                "%s: %llu rows of its own recording replace %llu; offset %+.3f s, drift %+.1f ppm",
                robot.c_str(), static_cast<unsigned long long>(rows),
                static_cast<unsigned long long>(replaced), clock.offset, clock.drift * 1e6);
  std::string out = text;
  if (clock.changes == 0) return out + " (as given)";
  std::snprintf(text, sizeof text, " (%zu changes fit, residual %.1f ms)", clock.changes,
                clock.residual * 1e3);
  return out + text;
}

Result<JoinReport> joinRecording(const std::string& sessionPath, const std::string& recordingPath,
                                 const std::string& output, const JoinOptions& options,
                                 const std::function<bool(double)>& progress) {
  const auto session = TRY(telemetry::SessionReader::open(sessionPath));
  const auto recording = TRY(telemetry::SessionReader::open(recordingPath));
  const auto inFile = [](Error error, const std::string& path) {
    error.context = path;
    return tl::unexpected(std::move(error));
  };
  const auto recorded = recordedGroup(recording);
  if (!recorded) return inFile(recorded.error(), recordingPath);
  const auto robot = robotOfSession(session, recording.groups()[*recorded].info, options.robot);
  if (!robot) return inFile(robot.error(), sessionPath);
  JoinReport report;
  report.robot = session.groups()[*robot].info.name;
  if (options.offset) {
    report.clock.offset = *options.offset;
    report.clock.drift = options.drift.value_or(0.0);
  } else {
    report.clock = TRY(fitClocks(session, *robot, recording, *recorded));
  }
  auto target = TRY(
      FileTarget::at(output, options.replace ? IfExists::Replace : IfExists::Refuse, sessionPath));
  telemetry::SessionWriterOptions writing;
  writing.waitWhenFull = true;
  writing.replace = true;
  const auto writer =
      TRY(telemetry::SessionWriter::create(target.partPath(), session.info(), writing));
  TRY(copyAttachments(session, *writer));
  for (const telemetry::SessionEvent& note : session.addedNotes()) writer->append(note);
  if (!Joiner(session, *robot, recording, *recorded, report.clock, *writer).run(report, progress)) {
    return failure(ErrorCode::Conflict, "Cancelled.");
  }
  TRY(writer->finish());
  TRY(target.commit());
  return report;
}

}  // namespace pitchboard::link
