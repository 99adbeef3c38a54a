// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/import_session.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <base/try.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/import/aligned_recordings.h>
#include <robotlink/import/opened_recordings.h>
#include <robotlink/live/live_events.h>
#include <robotlink/live/live_pipeline.h>
#include <robotlink/live/topic_groups.h>
#include <robotlink/live/topic_meanings.h>
#include <robotlink/live/topic_robots.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/session_events.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/session/session_writer.h>

namespace pitchboard::link {
namespace {

using telemetry::Duration;
using telemetry::RecordedItem;
using telemetry::RecordedMessage;
using telemetry::WallTime;

constexpr double robotTimeout = 2.0;  // s; then a robot is offline
constexpr double framePeriod = 0.1;   // s; events are found in frames
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

class SessionImport {
 public:
  SessionImport(std::vector<OpenedRecording> sources, const ImportOptions& options)
      : m_options(options), m_sources(std::move(sources)) {
    for (OpenedRecording& source : m_sources) {
      if (options.clock != RecordingClock::Auto) source.timing.clock = options.clock;
    }
  }

  Result<ImportReport> run(const std::string& path, const std::string& title,
                           const std::function<bool(double)>& progress) {
    TRY(chooseMapping());
    for (OpenedRecording& source : m_sources) TRY(source.step());
    if (earliestOf(m_sources) == nullptr) return nothing();
    TRY(begin(path, title));
    while (OpenedRecording* source = earliestOf(m_sources)) {
      takeItem(*source);
      TRY(source->step());
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
    for (const OpenedRecording& source : m_sources) {
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
      m_mapping = builtInMapping(topicsOf(m_sources));
    }
    if (!m_mapping.field.empty()) m_field = TRY(sim::fieldByName(m_mapping.field));
    m_log.emplace(m_mapping);
    if (m_mapping.referee) m_referee.emplace(*m_mapping.referee);
    return {};
  }

  double share() const {
    double sum = 0.0;
    for (const OpenedRecording& source : m_sources) sum += source.reader->progress();
    return sum / static_cast<double>(m_sources.size());
  }

  double secondsOf(std::int64_t time) const {
    return std::max(0.0, static_cast<double>(time - m_zero) / 1e9);
  }
  WallTime wallOf(double seconds) const {
    return WallTime(Duration(m_zero + std::llround(seconds * 1e9)));
  }

  Result<void> begin(const std::string& path, const std::string& title) {
    const std::int64_t first = earliestOf(m_sources)->time;
    m_zero = first >= 0 && first < firstClockTime ? 0 : first;
    telemetry::SessionInfo info;
    info.program = m_options.program;
    info.source = m_zero != 0 ? "live" : "import";  // with a time of day, or without
    info.title = title;
    info.start = WallTime(Duration(m_zero));
    info.created = std::chrono::system_clock::now();
    info.more["field"] = m_field.name;
    keepAlignment(m_mapping, info);
    telemetry::SessionWriterOptions writing;
    writing.waitWhenFull = true;
    writing.sync = false;
    writing.level = telemetry::McapWriterOptions::plainChunks;
    writing.chunkBytes = std::size_t{1} << 20;
    m_writer = TRY(telemetry::SessionWriter::create(path, info, writing));
    m_groups.emplace(*m_writer, [this](const LogLine& line) { m_writer->append(line); });
    TopicRobots::Options robots;
    robots.field = m_field;
    robots.timeout = robotTimeout;
    robots.nameOf = [this](const std::string& name) { return m_groups->freeName(name); };
    m_robots.emplace(*m_writer, m_mapping, std::move(robots));
    return {};
  }

  void takeItem(OpenedRecording& source) {
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

  bool takeLog(const telemetry::RecordedTopic& topic, const RecordedMessage& message, double time) {
    const auto line = m_log->lineOf(topic, message, time);
    if (!line) return false;
    m_writer->append(*line);
    ++m_logLines;
    return true;
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

  void takeReferee(const telemetry::RecordedTopic& topic, const RecordedMessage& message) {
    if (!m_referee) return;
    const auto bytes = m_referee->packetOf(topic, message);
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
    if (now - *m_framed > 2.0 * robotTimeout) {
      frameAt(*m_framed + robotTimeout + framePeriod);
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
    for (const OpenedRecording& source : m_sources) {
      for (std::string& note : source.reader->notes()) notes.push_back(std::move(note));
      if (source.stamps.usesStamps() == false) {
        notes.push_back(
            "The headers' times are of another clock than the log times, so log times "
            "are used. Use --time header for the others.");
      }
      if (source.stamps.odd() > 0) {
        notes.push_back(std::to_string(source.stamps.odd()) +
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

  const ImportOptions& m_options;
  std::vector<OpenedRecording> m_sources;
  TopicMapping m_mapping;
  sim::FieldSpec m_field;
  std::optional<TopicLog> m_log;
  std::optional<TopicReferee> m_referee;
  std::int64_t m_zero = 0;  ///< ns; second 0 of the session
  double m_now = 0.0;
  std::optional<double> m_first, m_framed;
  std::unique_ptr<telemetry::SessionWriter> m_writer;
  std::optional<TopicGroups> m_groups;
  std::optional<TopicRobots> m_robots;
  std::optional<LivePipeline> m_pipeline;
  std::shared_ptr<PipelineRecords> m_records;
  std::uint16_t m_refereePort = 0;
  LiveEvents m_events;
  std::map<int, std::uint64_t> m_teamMessages;  ///< by team
  std::uint64_t m_badReplies = 0, m_logLines = 0;
  ImportReport m_report;
};

/// The mapping with offsets that follow from an event.
Result<TopicMapping> alignedMapping(const std::vector<std::string>& files,
                                    const ImportOptions& options,
                                    const std::function<bool(double)>& progress) {
  TopicMapping mapping = options.mapping.value_or(TopicMapping());
  TRY(nameRecordings(files, mapping));
  if (!options.mapping) {
    const auto opened = TRY(openTogether(files, mapping.recordings, progress));
    TopicMapping usual = builtInMapping(topicsOf(opened));
    usual.recordings = std::move(mapping.recordings);
    mapping = std::move(usual);
  }
  for (MappedRecording& recording : mapping.recordings) {
    if (options.clock != RecordingClock::Auto) recording.clock = options.clock;
  }
  TRY(alignRecordings(files, *options.align, mapping,
                      [&progress] { return !progress || progress(0.0); }));
  return mapping;
}

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

std::string mappingBeside(const std::string& recording) {
  const std::filesystem::path whole(recording);
  const std::filesystem::path plain = whole.has_filename() ? whole : whole.parent_path();
  return (plain.parent_path() / plain.stem()).string() + ".mapping.json";
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
  ImportOptions used = options;
  const std::string beside = mappingBeside(files.front());
  std::error_code problem;
  const bool usesBeside = !used.mapping && std::filesystem::exists(beside, problem);
  if (usesBeside) used.mapping = TRY(mappingFromFile(beside));
  auto target = TRY(FileTarget::at(output, options.ifExists, files.front()));
  if (used.align) used.mapping = TRY(alignedMapping(files, used, progress));
  auto sources = TRY(openTogether(
      files, used.mapping ? used.mapping->recordings : std::vector<MappedRecording>(), progress));
  auto report = TRY(SessionImport(std::move(sources), used)
                        .run(target.partPath(), titleOf(files.front()), progress));
  TRY(target.commit());
  if (usesBeside) report.notes.push_back("The mapping is that of " + beside + ".");
  return report;
}

}  // namespace pitchboard::link
