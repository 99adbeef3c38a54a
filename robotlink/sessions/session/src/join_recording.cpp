// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/join_recording.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <utility>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/live/robot_uids.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/row_slot.h>
#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/session_writer.h>

namespace pitchboard::link {
namespace {

constexpr double readAtOnce = 1.0;  // s of the recording that are in memory
/// s without a row after which the robot did not record: the agent writes one every second.
constexpr double recordingGap = 2.5;

bool isMessagesGroup(const telemetry::GroupInfo& group) {
  const telemetry::RobotFacts& facts = factsOf(group);
  return facts.live && facts.linkOf.empty() && !isBoardGroup(group);
}

/// The rows of a robot's blackboard beside its messages, named as Live names them.
telemetry::GroupInfo boardBeside(const telemetry::GroupInfo& messages,
                                 const telemetry::GroupInfo& recorded) {
  telemetry::GroupInfo board{messages.name, {}, messages.robot};
  telemetry::RobotFacts& facts = *board.robot;
  facts.live = false;
  facts.sentFrom = std::exchange(facts.sender, {});
  facts.slot = factsOf(recorded).slot;
  facts.timeout_s = factsOf(recorded).timeout_s;
  board.id = groupId(facts.uid, RobotRows::Variables);
  return board;
}

telemetry::GroupInfo besideBoard(telemetry::GroupInfo messages) {
  messages.robot->linkOf = messages.name;
  messages.name += " telemetry";
  return messages;
}

/// Writes a session in which the rows of one robot are replaced while its own recording has rows.
class Joiner {
 public:
  Joiner(const telemetry::SessionReader& session, const JoinTarget& target,
         const RobotRecording& recording, const RobotClock& clock, telemetry::SessionWriter& writer)
      : m_session(session),
        m_target(target),
        m_recording(recording),
        m_clock(clock),
        m_writer(writer) {
    for (telemetry::GroupId id = 0; id < session.groups().size(); ++id) {
      const telemetry::GroupInfo& group = session.groups()[id].info;
      const bool moves = id == target.group && !target.isBoard;
      m_ids.push_back(writer.addGroup(moves ? besideBoard(group) : group));
    }
    m_range = recording.range();
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
          } else if (item.group != m_target.group || !m_target.isBoard || !isCovered(item.time)) {
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
  /// All columns of the recording, then those that only the replaced rows have.
  void mergeColumns() {
    const telemetry::GroupInfo& here = m_session.groups()[m_target.group].info;
    const telemetry::GroupInfo& there = m_recording.group();
    telemetry::GroupInfo both = m_target.isBoard ? here : boardBeside(here, there);
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
      if (m_target.isBoard) take(here, false);
    }
    m_joined = m_writer.addGroup(both);
  }

  /// Whether the robot recorded at this time, until which everything recorded was taken.
  bool isCovered(double time) {
    if (!m_newest) return false;
    if (time <= *m_newest) return true;
    const auto next = nextTime();
    return next && *next - *m_newest <= recordingGap;
  }

  /// Returns the time of the next recorded row in the session; nothing after the last one.
  std::optional<double> nextTime() {
    while (m_taken == m_block.size()) {
      if (m_next > m_range.end) return {};
      readBlock();
    }
    return m_clock.toSession(m_block[m_taken].time);
  }

  /// Writes the recorded rows until this time of the session.
  void takeRecorded(double until) {
    for (auto next = nextTime(); next && *next <= until; next = nextTime()) {
      write(m_block[m_taken++]);
      m_newest = *next;
    }
  }

  void readBlock() {
    m_block.clear();
    m_taken = 0;
    const double begin = std::exchange(m_next, m_next + readAtOnce);
    m_recording.rows({begin, m_next}, [&](const telemetry::RowView& row) {
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
  const JoinTarget m_target;
  const RobotRecording& m_recording;
  const RobotClock m_clock;
  telemetry::SessionWriter& m_writer;
  std::vector<telemetry::GroupId> m_ids;  // in the new file, of the session's groups
  telemetry::GroupId m_joined = 0;
  std::vector<std::pair<bool, RowSlot>> m_places;  // of the joined columns: of the recording?
  telemetry::TimeRange m_range;                    // of the recording
  std::vector<telemetry::SessionRow> m_block;
  std::size_t m_taken = 0;         // rows of the block
  double m_next = 0.0;             // where the next block begins
  std::optional<double> m_newest;  // s of the session, of the newest recorded row
  telemetry::SessionRow m_held;    // the newest row of the session
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

std::vector<JoinTarget> joinTargets(const telemetry::SessionReader& session,
                                    const RobotRecording& recording) {
  std::vector<JoinTarget> targets;
  const int number = factsOf(recording.group()).slot;
  const auto groups = session.groups();
  for (const bool isBoard : {true, false}) {
    for (telemetry::GroupId id = 0; id < groups.size(); ++id) {
      const telemetry::GroupInfo& group = groups[id].info;
      if (isBoard ? !isBoardGroup(group) : !isMessagesGroup(group)) continue;
      const telemetry::RobotFacts& facts = factsOf(group);
      targets.push_back({group.name, id, isBoard, (isBoard ? facts.slot : facts.number) == number});
    }
  }
  std::ranges::stable_sort(targets, std::greater(), &JoinTarget::isProposed);
  return targets;
}

Result<ComparedTarget> compareTarget(const telemetry::SessionReader& session,
                                     const RobotRecording& recording, const std::string& robot,
                                     const std::function<bool()>& goesOn) {
  const std::vector<JoinTarget> targets = joinTargets(session, recording);
  const std::string& sessionName = session.file().contents().name;
  if (targets.empty()) {
    return failure(ErrorCode::NotFound,
                   "The session has no blackboard and no messages of a live robot, so there is "
                   "nothing to join to.",
                   sessionName);
  }
  std::optional<ComparedTarget> best;
  double most = -1.0;
  std::string names;
  for (const JoinTarget& target : targets) {
    names += (names.empty() ? "" : ", ") + target.robot;
    if (robot.empty() ? !target.isProposed : robot != target.robot) continue;
    // A robot's blackboard tells more than the messages of another one with its number.
    if (best && best->target.isBoard && !target.isBoard && best->fit) continue;
    ComparedTarget compared{
        target, TRY(ClockComparison::read(session, target.group, recording, goesOn)), ClockFit{}};
    compared.fit = compared.comparison.fit();
    const double share =
        compared.fit ? compared.comparison.agreement(compared.fit->clock).share() : 0.0;
    if (share <= most) continue;
    most = share;
    best.emplace(std::move(compared));
  }
  if (best) return *std::move(best);
  return failure(ErrorCode::NotFound,
                 "The session has no " +
                     (robot.empty() ? "robot " + std::to_string(factsOf(recording.group()).slot)
                                    : "rows of " + robot) +
                     ". Name the robot with --robot: " + names + ".",
                 sessionName);
}

std::string JoinReport::summary() const {
  char text[240];
  std::snprintf(text, sizeof text, "%s: %llu rows of its own recording", robot.c_str(),
                static_cast<unsigned long long>(rows));
  std::string out = text;
  if (files > 1) out += " (" + std::to_string(files) + " files)";
  out += replaced > 0 ? " replace " + std::to_string(replaced) : " stand beside its messages";
  std::snprintf(text, sizeof text, "; offset %+.3f s, drift %+.1f ppm", clock.offset,
                clock.drift * 1e6);
  return out + text + (fit ? " (" : " (as given; ") + agreement.text() + ')';
}

Result<JoinReport> joinRecording(const std::string& sessionPath, const std::string& recordingPath,
                                 const std::string& output, const JoinOptions& options,
                                 const std::function<bool(double)>& progress) {
  const auto session = TRY(telemetry::SessionReader::open(sessionPath));
  const auto recording = TRY(RobotRecording::open(recordingPath));
  const auto goesOn = [&progress] { return !progress || progress(0.0); };
  const ComparedTarget compared = TRY(compareTarget(session, recording, options.robot, goesOn));
  JoinReport report;
  report.robot = compared.target.robot;
  report.files = recording.files();
  report.notes = recording.notes();
  if (options.offset) {
    report.clock = {*options.offset, options.drift.value_or(0.0)};
  } else {
    report.fit = TRY(Result<ClockFit>(compared.fit));
    report.clock = report.fit->clock;
  }
  report.agreement = compared.comparison.agreement(report.clock);
  auto target = TRY(
      FileTarget::at(output, options.replace ? IfExists::Replace : IfExists::Refuse, sessionPath));
  telemetry::SessionWriterOptions writing;
  writing.waitWhenFull = true;
  writing.replace = true;
  const auto writer =
      TRY(telemetry::SessionWriter::create(target.partPath(), session.info(), writing));
  TRY(copyAttachments(session, *writer));
  if (!session.attachment(catalogAttachment)) {
    if (const auto map = recording.catalog()) {
      writer->attach(catalogAttachment, "application/json", *map);
    }
  }
  for (const telemetry::SessionEvent& note : session.addedNotes()) {
    if (note.kind != info(MatchEventKind::Note).name) writer->append(note);
  }
  if (!Joiner(session, compared.target, recording, report.clock, *writer).run(report, progress)) {
    return failure(ErrorCode::Conflict, "Cancelled.");
  }
  TRY(writer->finish());
  TRY(target.commit());
  TRY(telemetry::copyDrawnNotes(sessionPath, output, {-1e18, 1e18}));
  return report;
}

}  // namespace pitchboard::link
