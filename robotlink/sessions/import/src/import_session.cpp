// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/import_session.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/try.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/live_events.h>
#include <robotlink/live/live_pipeline.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/session_events.h>
#include <telemetry/session/session_writer.h>
#include <telemetry/wire/gamecontroller_encoder.h>

#include "imported_groups.h"
#include "imported_robots.h"

namespace pitchboard::link {
namespace {

using telemetry::Duration;
using telemetry::RecordedItem;
using telemetry::RecordedMessage;
using telemetry::RecordingReader;
using telemetry::WallTime;

constexpr double framePeriod = 0.1;      // s; events are found in frames
constexpr double maxStampOffset = 60.0;  // s; beyond it, stamp and log time are of two clocks
/// Times before this are not of a clock: seconds of the session are those of the recording.
constexpr std::int64_t firstClockTime = 100'000'000LL * 1'000'000'000LL;
constexpr std::uint64_t itemsBetweenReports = 1000;
constexpr std::uint16_t robotStatusPort = 3939;
constexpr int teamMessagesFrom = 10'000, teamMessagesTo = 10'255;
constexpr telemetry::Address mappedReferee{0x7f000001};

/// Writes what the pipeline reports, besides events.
class PipelineRecords : public LiveRecords {
 public:
  explicit PipelineRecords(telemetry::SessionWriter& writer) : m_writer(writer) {}

 protected:
  void keep(LiveRecord record) override { appendRecord(m_writer, record); }

 private:
  telemetry::SessionWriter& m_writer;
};

/// One of the recordings that are imported together.
struct ImportSource {
  std::unique_ptr<RecordingReader> reader;
  RecordedItem item = RecordedItem::End;
  std::optional<bool> usesStamps;  ///< with ImportClock::Auto: decided by the first stamp
  std::uint64_t oddStamps = 0;
  std::int64_t time = 0;  ///< of the item, ns
};

class SessionImport {
 public:
  SessionImport(std::vector<std::unique_ptr<RecordingReader>> readers, const ImportOptions& options)
      : m_options(options) {
    for (auto& reader : readers)
      m_sources.push_back({std::move(reader), RecordedItem::End, {}, 0, 0});
  }

  Result<ImportReport> run(const std::string& path, const std::string& title,
                           const std::function<bool(double)>& progress) {
    TRY(chooseMapping());
    for (ImportSource& source : m_sources) TRY(step(source));
    if (nextSource() == nullptr) return nothing();
    TRY(begin(path, title));
    while (ImportSource* source = nextSource()) {
      takeItem(*source);
      TRY(step(*source));
      if (m_report.messages % itemsBetweenReports == 0 && progress && !progress(share())) {
        return failure(ErrorCode::Conflict, "The import was stopped. Nothing was written.");
      }
    }
    finishFrames();
    return end();
  }

 private:
  Result<ImportReport> nothing() {
    std::string why = "Nothing in the recording can be imported.";
    for (const ImportSource& source : m_sources) {
      for (const std::string& note : source.reader->notes()) {
        if (why.size() < 2000) why += "\n  " + note;
      }
    }
    return failure(ErrorCode::NotFound, std::move(why));
  }

  Result<void> chooseMapping() {
    if (m_options.mapping) {
      m_mapping = *m_options.mapping;
    } else {
      std::vector<telemetry::RecordedTopic> topics;
      for (const ImportSource& source : m_sources) {
        const auto& own = source.reader->topics();
        topics.insert(topics.end(), own.begin(), own.end());
      }
      m_mapping = builtInMapping(topics);
    }
    if (!m_mapping.field.empty()) m_field = TRY(sim::fieldByName(m_mapping.field));
    for (const ImportLog& log : m_mapping.log) {
      m_logs.push_back({log.topic, ImportPath(log.text), ImportPath(log.level),
                        ImportPath(log.origin), log.topic});
    }
    return {};
  }

  Result<void> step(ImportSource& source) {
    source.item = TRY(source.reader->next());
    if (source.item == RecordedItem::Message) {
      source.time = timeOf(source, source.reader->message());
    } else if (source.item == RecordedItem::Datagram) {
      source.time = source.reader->datagram().time;
    }
    return {};
  }

  std::int64_t timeOf(ImportSource& source, const RecordedMessage& message) const {
    if (m_options.clock == ImportClock::Log || !message.stamp || *message.stamp <= 0) {
      return message.logTime;
    }
    if (m_options.clock == ImportClock::Header) return *message.stamp;
    const double offset =
        std::abs(static_cast<double>(*message.stamp) - static_cast<double>(message.logTime)) / 1e9;
    const bool isNear = offset <= maxStampOffset;
    if (!source.usesStamps) source.usesStamps = isNear;
    if (!*source.usesStamps) return message.logTime;
    if (isNear) return *message.stamp;
    ++source.oddStamps;
    return message.logTime;
  }

  ImportSource* nextSource() {
    ImportSource* next = nullptr;
    for (ImportSource& source : m_sources) {
      if (source.item == RecordedItem::End) continue;
      if (next == nullptr || source.time < next->time) next = &source;
    }
    return next;
  }

  double share() const {
    double sum = 0.0;
    for (const ImportSource& source : m_sources) sum += source.reader->progress();
    return sum / static_cast<double>(m_sources.size());
  }

  double secondsOf(std::int64_t time) const {
    return std::max(0.0, static_cast<double>(time - m_zero) / 1e9);
  }
  WallTime wallOf(double seconds) const {
    return WallTime(Duration(m_zero + std::llround(seconds * 1e9)));
  }

  Result<void> begin(const std::string& path, const std::string& title) {
    const std::int64_t first = nextSource()->time;
    m_zero = first >= 0 && first < firstClockTime ? 0 : first;
    telemetry::SessionInfo info;
    info.program = m_options.program;
    info.source = m_zero != 0 ? "live" : "import";  // with a time of day, or without
    info.title = title;
    info.start = WallTime(Duration(m_zero));
    info.created = std::chrono::system_clock::now();
    info.more["field"] = m_field.name;
    telemetry::SessionWriterOptions writing;
    writing.waitWhenFull = true;
    writing.sync = false;
    writing.level = 1;
    writing.chunkBytes = std::size_t{4} << 20;
    m_writer = TRY(telemetry::SessionWriter::create(path, info, writing));
    m_groups.emplace(*m_writer);
    m_robots.emplace(*m_writer, m_mapping, m_field,
                     [this](const std::string& name) { return m_groups->freeName(name); });
    return {};
  }

  void takeItem(ImportSource& source) {
    ++m_report.messages;
    m_now = std::max(m_now, secondsOf(source.time));
    m_first = m_first.value_or(m_now);
    makeFrames(m_now);
    if (source.item == RecordedItem::Datagram) return takeDatagram(source.reader->datagram());
    const RecordedMessage& message = source.reader->message();
    const telemetry::RecordedTopic& topic = source.reader->topics()[message.topic];
    const double time = secondsOf(source.time);
    m_robots->take(topic, message, time);
    takeReferee(topic, message);
    if (takeLog(topic, message, time)) return;
    m_groups->take(static_cast<std::size_t>(&source - m_sources.data()), topic, message, time);
  }

  struct LogPaths {
    std::string topic;
    ImportPath text, level, origin;
    std::string fallback;
  };

  /// ROS 2 counts levels in tens, ROS 1 in powers of two.
  static LogLevel levelOf(std::optional<double> code) {
    if (!code) return LogLevel::Info;
    const bool isRos1 = *code == 1 || *code == 2 || *code == 4 || *code == 8 || *code == 16;
    const double level = isRos1 ? 10.0 * (1.0 + std::log2(*code)) : *code;
    return level >= 50   ? LogLevel::Fatal
           : level >= 40 ? LogLevel::Error
           : level >= 30 ? LogLevel::Warning
           : level >= 20 ? LogLevel::Info
                         : LogLevel::Debug;
  }

  bool takeLog(const telemetry::RecordedTopic& topic, const RecordedMessage& message, double time) {
    for (const LogPaths& paths : m_logs) {
      if (paths.topic != topic.name) continue;
      const auto text = paths.text.text(message);
      if (!text) continue;
      LogLine line;
      line.time = time;
      line.text = *text;
      line.origin = paths.origin.text(message).value_or(paths.fallback);
      line.level = levelOf(paths.level.number(message));
      m_writer->append(line);
      ++m_logLines;
      return true;
    }
    return false;
  }

  /// A referee is received as in a live match.
  LivePipeline& pipeline() {
    if (!m_pipeline) {
      LiveOptions live;
      live.field = m_field;
      m_refereePort = static_cast<std::uint16_t>(live.refereePort);
      m_pipeline.emplace(std::move(live), WallTime(Duration(m_zero)));
      m_records = std::make_shared<PipelineRecords>(*m_writer);
      m_pipeline->observe(m_records, wallOf(m_now));
    }
    return *m_pipeline;
  }

  void takeDatagram(const telemetry::RecordedDatagram& datagram) {
    if (datagram.localPort >= teamMessagesFrom && datagram.localPort <= teamMessagesTo) {
      ++m_teamMessages[datagram.localPort - teamMessagesFrom];
      return;
    }
    LivePipeline& live = pipeline();
    if (datagram.localPort == robotStatusPort) {
      const auto packet = telemetry::decodeReferee(datagram.payload);
      const auto* reply = packet ? std::get_if<telemetry::RobotReply>(&*packet) : nullptr;
      const auto& game = live.frame(wallOf(m_now)).game;
      if (reply == nullptr || !game) {
        ++m_badReplies;
        return;
      }
      m_robots->take(*reply, *game, m_now);
    }
    // Replies come to the referee's port, as in the years when robots sent them there.
    live.take({wallOf(m_now), datagram.sender, m_refereePort, false, datagram.payload});
  }

  /// The mapping's referee, as a packet of the version that says most.
  void takeReferee(const telemetry::RecordedTopic& topic, const RecordedMessage& message) {
    if (!m_mapping.referee || m_mapping.referee->topic != topic.name) return;
    if (!m_refereePaths) m_refereePaths.emplace(*m_mapping.referee);
    const RefereePaths& paths = *m_refereePaths;
    const auto state = paths.state.number(message);
    if (!state) return;
    const auto whole = [&message](const ImportPath& path, int fallback, int most) {
      return static_cast<int>(std::lround(
          std::clamp(path.number(message).value_or(fallback), -1.0 * most, 1.0 * most)));
    };
    telemetry::RefereeState packet;
    packet.version = 12;
    packet.size = telemetry::refereePacketSize(packet.version, 688).value_or(0);
    packet.state = std::clamp(static_cast<int>(std::lround(*state)), 0, 4);
    packet.firstHalf = whole(paths.firstHalf, 1, 1) != 0 ? 1 : 0;
    packet.secsRemaining = whole(paths.secondsLeft, 0, 32'767);
    packet.packetNumber = m_refereePackets++ & 0xff;
    packet.secState = packet.gameType = packet.dropInTeam = packet.secondaryTime = 0;
    packet.dropInTime = -1;
    packet.secStateInfo.emplace();
    for (const bool right : {false, true}) {
      telemetry::RefereeTeam& team = packet.teams[right ? 1 : 0];
      team.number = right ? 2 : 1;
      team.colour =
          telemetry::colourCode(right ? m_mapping.referee->right : m_mapping.referee->left);
      team.score = std::max(0, whole(right ? paths.rightScore : paths.leftScore, 0, 255));
      team.penaltyShot = team.singleShots = 0;
      team.slotCount = telemetry::refereeSlots(packet.version, packet.size);
      for (std::size_t i = 0; i < team.slotCount; ++i) {
        team.allSlots[i].number = static_cast<int>(i) + 1;
        team.allSlots[i].warnings = team.allSlots[i].yellow = team.allSlots[i].red = 0;
        team.allSlots[i].goalkeeper = 0;
      }
    }
    const auto bytes = telemetry::encodeReferee(packet);
    if (!bytes) return;
    LivePipeline& live = pipeline();
    live.take({wallOf(m_now), {mappedReferee, m_refereePort}, m_refereePort, false, *bytes});
  }

  /// Frames before what happens at `now`.
  void makeFrames(double now) {
    if (!m_framed) {
      m_framed = now;
      return;
    }
    // In a silence the robots go offline.
    if (now - *m_framed > 2.0 * ImportedRobots::timeout) {
      frameAt(*m_framed + ImportedRobots::timeout + framePeriod);
    }
    if (now - *m_framed >= framePeriod) frameAt(now);
  }

  void finishFrames() {
    if (m_framed) frameAt(m_now);
  }

  void frameAt(double time) {
    m_framed = time;
    MatchFrame frame;
    if (m_pipeline) {
      frame = m_pipeline->advance(wallOf(time));
    } else {
      frame.origin = FrameOrigin::Recorded;
      frame.teams = teamsByColour();
    }
    frame.snapshot.time = time;
    std::vector<RobotFrame> robots = m_robots->frames(time, frame.game);
    std::vector<std::optional<Penalty>> penalties;
    for (const RobotFrame& robot : robots) penalties.push_back(robot.penalty);
    const auto uids = joinBoards(frame, std::move(robots));
    for (std::size_t i = 0; i < uids.size(); ++i) {
      const auto robot = std::ranges::find(frame.robots, uids[i], &RobotFrame::uid);
      if (robot != frame.robots.end() && !robot->penalty) robot->penalty = penalties[i];
    }
    for (MatchEvent& event : m_robots->drainEvents()) addEvent(std::move(event));
    for (MatchEvent& event : m_events.compare(frame)) {
      if (event.kind == MatchEventKind::RobotReceived) {
        if (const RobotFrame* robot = frame.robot(event.robot)) {
          event.detail = m_robots->sourceOf(robot->uid);
        }
      }
      addEvent(std::move(event));
    }
  }

  void addEvent(MatchEvent event) {
    m_writer->append(sessionEvent(event));
    ++m_report.events;
  }

  Result<ImportReport> end() {
    const auto status = m_writer->status();
    TRY(m_writer->finish());
    m_report.rows = status.rows;
    m_report.logLines = m_logLines + m_groups->logLines();
    m_report.variables = m_groups->variables() + m_robots->variables();
    m_report.seconds = m_now - m_first.value_or(m_now);
    m_report.robots = m_robots->names();
    std::vector<std::string>& notes = m_report.notes;
    for (const ImportSource& source : m_sources) {
      for (std::string& note : source.reader->notes()) notes.push_back(std::move(note));
      if (source.usesStamps == false) {
        notes.push_back(
            "The headers' times are of another clock than the log times, so log times "
            "are used. Use --time header for the others.");
      }
      if (source.oddStamps > 0) {
        notes.push_back(std::to_string(source.oddStamps) +
                        " messages have a header time more than a minute from their log time, "
                        "which is used instead.");
      }
    }
    m_groups->addNotes(notes);
    m_robots->addNotes(notes);
    for (const auto& [team, count] : m_teamMessages) {
      notes.push_back("Team " + std::to_string(team) + ": " + std::to_string(count) +
                      " team messages are not decoded.");
    }
    if (m_badReplies > 0) {
      notes.push_back(std::to_string(m_badReplies) + " replies of robots cannot be decoded.");
    }
    return std::move(m_report);
  }

  struct RefereePaths {
    explicit RefereePaths(const ImportReferee& from)
        : state(from.state),
          secondsLeft(from.secondsLeft),
          firstHalf(from.firstHalf),
          leftScore(from.leftScore),
          rightScore(from.rightScore) {}
    ImportPath state, secondsLeft, firstHalf, leftScore, rightScore;
  };

  const ImportOptions& m_options;
  std::vector<ImportSource> m_sources;
  ImportMapping m_mapping;
  sim::FieldSpec m_field;
  std::vector<LogPaths> m_logs;
  std::optional<RefereePaths> m_refereePaths;
  std::int64_t m_zero = 0;  ///< ns; second 0 of the session
  double m_now = 0.0;
  std::optional<double> m_first, m_framed;
  std::unique_ptr<telemetry::SessionWriter> m_writer;
  std::optional<ImportedGroups> m_groups;
  std::optional<ImportedRobots> m_robots;
  std::optional<LivePipeline> m_pipeline;
  std::shared_ptr<PipelineRecords> m_records;
  std::uint16_t m_refereePort = 0;
  int m_refereePackets = 0;
  LiveEvents m_events;
  std::map<int, std::uint64_t> m_teamMessages;  ///< by team
  std::uint64_t m_badReplies = 0, m_logLines = 0;
  ImportReport m_report;
};

std::string titleOf(const std::string& path) {
  const auto slash = path.find_last_not_of('/');
  const std::string plain = slash == path.npos ? path : path.substr(0, slash + 1);
  return plain.substr(plain.rfind('/') == plain.npos ? 0 : plain.rfind('/') + 1);
}

}  // namespace

std::string ImportReport::summary() const {
  const auto count = [](std::uint64_t n, const char* what) {
    return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
  };
  std::string text =
      count(messages, "message") + ", " + count(variables, "variable") + ", " + count(rows, "row");
  if (logLines > 0) text += ", " + count(logLines, "log line");
  if (events > 0) text += ", " + count(events, "event");
  if (!robots.empty()) {
    text += robots.size() == 1 ? ", robot" : ", robots";
    for (std::size_t i = 0; i < robots.size(); ++i) text += (i == 0 ? " " : ", ") + robots[i];
  }
  return text;
}

Result<ImportReport> importRecordings(const std::vector<std::string>& files,
                                      const std::string& output, const ImportOptions& options,
                                      const std::function<bool(double)>& progress) {
  if (files.empty()) {
    return failure(ErrorCode::InvalidArgument, "There is nothing to import: name a recording.");
  }
  for (const std::string& file : files) {
    if (isSameFile(file, output)) {
      return failure(ErrorCode::Conflict,
                     "The session would replace its own recording. Choose another name.", output);
    }
  }
  auto target = TRY(FileTarget::at(output, options.ifExists, files.front()));
  auto readers = TRY(telemetry::openRecordings(files, progress));
  auto report = TRY(SessionImport(std::move(readers), options)
                        .run(target.partPath(), titleOf(files.front()), progress));
  TRY(target.commit());
  return report;
}

}  // namespace pitchboard::link
