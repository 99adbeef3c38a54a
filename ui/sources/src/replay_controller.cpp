// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/replay_controller.h>

#include <QFileInfo>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <robotlink/experiment/run_player.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>
#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/session_notes.h>
#include <ui/base/robot_text.h>
#include <ui/sources/event_list.h>

#include "replay_pages.h"

namespace pitchboard::ui {
namespace {

QDateTime dateTimeOf(telemetry::WallTime time) {
  return QDateTime::fromMSecsSinceEpoch(
      std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
}

/// The first moment that shows all the robots that come within some seconds, and the referee if
/// it does: of a live match its first datagram is that of one robot.
double firstMomentOf(const telemetry::SessionReader& session, telemetry::TimeRange range,
                     link::RecordedFrames& frames) {
  constexpr double soon = 3.0, step = 0.1;  // s
  double first = range.begin;
  if (frames.frameAt(session, first).robots.empty()) {
    session.rows(range, {}, [&](telemetry::GroupId group, const telemetry::RowView& row) {
      const telemetry::RobotFacts& facts = factsOf(session.groups()[group].info);
      if (facts.slot == 0 && facts.number == 0) return true;
      first = row.time;
      return false;
    });
  }
  const double last = std::min(first + soon, range.end);
  const link::MatchFrame all = frames.frameAt(session, last);
  for (double time = first; time < last; time += step) {
    const link::MatchFrame now = frames.frameAt(session, time);
    const bool hasReferee = now.game || !all.game;
    if (now.robots.size() >= all.robots.size() && hasReferee) return time;
  }
  return last;
}

/// How far the rows of a file are in memory; s.
struct RowsRead {
  static constexpr double never = std::numeric_limits<double>::infinity();
  std::atomic<double> first = never;   ///< of the first row, which may have been dropped since
  std::atomic<double> whole = -never;  ///< up to here every row has been read
};

/// Rows on their way into memory; looks now and then whether anybody still wants them. What is
/// damaged anywhere in the file, in sentences.
QStringList readRows(const QString& path, telemetry::SeriesStore& store, RowsRead& read,
                     const std::function<bool(double)>& goOn) {
  const auto session = telemetry::SessionReader::open(path.toStdString());
  if (!session) return {};
  const auto range = session->range();
  if (!range) return {};
  std::vector<telemetry::GroupId> ids;
  for (const telemetry::SessionGroup& group : session->groups()) {
    ids.push_back(store.addGroup(shownGroup(group)));
  }
  constexpr std::uint64_t rowsBetweenLooks = 4096;
  std::uint64_t rows = 0;
  bool wanted = true;
  const double length = std::max(range->end - range->begin, 1e-9);
  session->rows(*range, {}, [&](telemetry::GroupId group, const telemetry::RowView& row) {
    store.append(ids[group], row);
    if (row.time < read.first) read.first = row.time;
    if (++rows % rowsBetweenLooks == 0) {
      // Groups do not come quite in step.
      constexpr double disorder = 1.0;
      read.whole = row.time - disorder;
      wanted = goOn((row.time - range->begin) / length);
    }
    return wanted;
  });
  if (wanted) read.whole = range->end;
  if (!wanted || !session->check([&goOn](double) { return goOn(1.0); })) return {};
  QStringList damage;
  if (!session->isDamaged()) return damage;
  for (const std::string& note : session->notes()) damage << QString::fromStdString(note);
  return damage;
}

/// Events as lines of the log, in their place by time.
void addEvents(const std::vector<link::MatchEvent>& events, std::vector<LogLine>& log) {
  for (const link::MatchEvent& event : events) log.push_back(logLineOf(event));
  std::stable_sort(log.begin(), log.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
}

}  // namespace

// The reader is used by the seeking thread only, once the file is open; the rest does not change.
struct ReplayController::File {
  telemetry::SessionReader session;
  telemetry::SessionInfo info;
  telemetry::TimeRange range;
  link::RecordedFrames frames;
  link::RecordedFrames memoryFrames;  // UI thread
  std::shared_ptr<telemetry::SeriesStore> rows;
  std::vector<link::MatchEvent> events;
  telemetry::DrawnNotes drawn;
  std::vector<LogLine> log;
  std::string scenario;
  QString recording;
  bool broken = false;
  bool growing = false;
  bool live = false;   ///< moments are made of datagrams, which only the file holds
  bool paged = false;  ///< its rows do not fit
  bool unrepeatable = false;
  RowsRead read;
  double start = 0.0;
  QStringList notes;
  FramePtr first;
  std::vector<telemetry::GroupInfo> groups;

  explicit File(telemetry::SessionReader reader)
      : session(std::move(reader)),
        info(session.info()),
        frames(link::backdropOf(session)),
        memoryFrames(link::backdropOf(session)),
        live(session.count(telemetry::SessionStream::LiveState) > 0 ||
             session.count(telemetry::SessionStream::Telemetry) > 0) {
    for (const telemetry::SessionGroup& group : session.groups()) groups.push_back(group.info);
  }

  void readEvents() {
    events = link::eventsOf(session);
    std::erase_if(events, isMadeByStudio);
    constexpr std::size_t maxLines = 10'000;
    session.messages(telemetry::SessionStream::Log, range,
                     [this](double time, std::string_view json) {
                       if (auto line = telemetry::sessionLogLine(json)) {
                         line->time = time;
                         log.push_back(std::move(*line));
                       }
                       return log.size() < maxLines;
                     });
    addEvents(events, log);
  }
};

ReplayController::ReplayController(QObject* parent) : FrameSource(parent) {}

ReplayController::~ReplayController() {
  ++m_generation;
  ++m_loading;
  m_seeker.waitForDone();
  m_loader.waitForDone();
  dropPages();
}

/// Views of its rows may still be in use.
void ReplayController::dropPages() {
  if (m_pages) m_pages->setListener({});
  m_pages.reset();
}

QString ReplayController::recording() const {
  return m_file ? m_file->recording : QString();
}

telemetry::SessionInfo ReplayController::info() const {
  return m_file ? m_file->info : telemetry::SessionInfo{};
}

bool ReplayController::isBroken() const {
  return m_file && m_file->broken;
}

bool ReplayController::isGrowing() const {
  return m_file && m_file->growing;
}

bool ReplayController::isUnrepeatable() const {
  return m_file && m_file->unrepeatable;
}

std::span<const telemetry::DrawnNote> ReplayController::drawnNotes() const {
  return m_file ? std::span<const telemetry::DrawnNote>(m_file->drawn.notes)
                : std::span<const telemetry::DrawnNote>();
}

std::string ReplayController::attachedScenario() const {
  return m_file ? m_file->scenario : std::string();
}

std::shared_ptr<const telemetry::SeriesStore> ReplayController::series() const {
  return m_file ? m_file->rows : nullptr;
}

std::vector<telemetry::GroupInfo> ReplayController::groups() const {
  return m_file ? m_file->groups : std::vector<telemetry::GroupInfo>();
}

QString ReplayController::emptyText() const {
  return isOpening() ? QStringLiteral("Opening…")
         : isOpen()  ? QStringLiteral("The session has no robots at this moment.")
                     : QStringLiteral(
                           "No session is open.\nDrop a recorded session (.mcap) here, or choose "
                            "File > Open session.");
}

std::optional<QDateTime> ReplayController::clock() const {
  if (!m_file || m_file->info.source != "live" || m_file->info.start == telemetry::WallTime{}) {
    return {};
  }
  return dateTimeOf(m_file->info.start);
}

void ReplayController::open(const QString& path, const QString& recording) {
  const std::uint64_t mine = ++m_generation;
  m_opening = true;
  m_seeker.start([this, path, recording, mine, budget = m_budget] {
    auto session = telemetry::SessionReader::open(path.toStdString());
    QString problem;
    std::shared_ptr<File> file;
    if (!session) {
      problem = QString::fromStdString(session.error().text());
    } else if (session->isForeign()) {
      m_toUi.post([this, path, mine] {
        if (mine != m_generation) return;
        m_opening = false;
        emit foreignFound(path);
      });
      return;
    } else if (const auto range = session->range(); !range) {
      problem = QStringLiteral("%1 has no rows and no messages").arg(path);
    } else {
      file = std::make_shared<File>(std::move(*session));
      file->range = {range->begin, range->end};
      // Damage that is met from here on is told by damageFound().
      for (const std::string& note : file->session.notes()) {
        file->notes << QString::fromStdString(note);
      }
      file->start = firstMomentOf(file->session, file->range, file->frames);
      file->first =
          std::make_shared<link::MatchFrame>(file->frames.frameAt(file->session, file->start));
      file->paged =
          file->session.hasSummaries() && bytesOfRows(file->session) > static_cast<double>(budget);
      // Of a long session they come after the first frame.
      if (!file->paged) file->readEvents();
      if (auto scenario = file->session.attachment(link::scenarioAttachment)) {
        file->scenario = std::move(*scenario);
      }
      // What is wrong with them, the reader has noted.
      const std::string named = (recording.isEmpty() ? path : recording).toStdString();
      if (auto drawn = telemetry::readDrawnNotes(named)) file->drawn = std::move(*drawn);
      file->growing = file->session.isGrowing();
      file->broken = !file->session.complete() && !file->growing;
      file->unrepeatable = !link::isRunRepeatable(path.toStdString()).value_or(true);
    }
    m_toUi.post([this, file, problem, path, recording, mine] {
      if (mine != m_generation) return;
      m_opening = false;
      if (!file) {
        emit failed(QStringLiteral("Could not open the session: %1").arg(problem));
        return;
      }
      m_path = path;
      file->recording = recording.isEmpty() ? path : recording;
      take(file);
    });
    if (!file || !file->paged) return;
    file->readEvents();
    m_toUi.post([this, mine] {
      if (mine == m_generation) reportRecorded();
    });
  });
}

void ReplayController::reportRecorded() {
  emit eventsRecorded(m_file->events);
  if (!m_file->log.empty()) emit logReceived(m_file->log);
}

void ReplayController::close() {
  ++m_generation;
  ++m_loading;
  dropPages();
  m_file.reset();
  m_frame.reset();
  m_path.clear();
  m_wanted.reset();
  m_opening = false;
  emit restarted();
}

void ReplayController::take(std::shared_ptr<File> file) {
  dropPages();
  m_file = std::move(file);
  m_file->rows = std::make_shared<telemetry::SeriesStore>(telemetry::SeriesOptions{m_budget});
  m_frame = m_file->first;
  m_wanted.reset();
  m_time = m_file->start;
  emit restarted();
  emit frameReceived(m_frame);
  if (!m_file->paged) reportRecorded();
  emit opened();
  if (!m_file->notes.isEmpty()) emit noted(m_file->notes);
  if (m_file->paged) {
    page();
  } else {
    load();
  }
}

FramePtr ReplayController::frameAt(double time) const {
  if (!m_file || m_file->live || m_file->paged) return nullptr;
  const auto held = m_file->rows->range();
  // Memory answers at once where it holds what came before this moment as well, and every robot's
  // row of the moment itself.
  if (held && held->begin <= m_file->range.begin + 1e-9 && time <= m_file->read.whole) {
    return std::make_shared<link::MatchFrame>(m_file->memoryFrames.frameAt(*m_file->rows, time));
  }
  return nullptr;
}

std::optional<telemetry::TimeRange> ReplayController::available() const {
  return m_file ? std::optional(m_file->range) : std::nullopt;
}

void ReplayController::standAt(double time) {
  if (!m_file || !std::isfinite(time)) return;
  time = std::clamp(time, m_file->range.begin, m_file->range.end);
  if (std::exchange(m_time, time) == time) return;
  m_wanted = time;
  if (FramePtr held = frameAt(time)) {
    m_wanted.reset();
    m_frame = std::move(held);
    emit frameReceived(m_frame);
    return;
  }
  readMoment();
}

void ReplayController::readMoment() {
  if (m_reading || !m_wanted || !m_file) return;
  m_reading = true;
  m_seeker.start(
      [this, file = m_file, time = *std::exchange(m_wanted, {}), mine = m_generation.load()] {
        auto frame = std::make_shared<link::MatchFrame>(file->frames.frameAt(file->session, time));
        m_toUi.post([this, frame, mine] {
          m_reading = false;
          if (mine == m_generation) {
            m_frame = frame;
            emit frameReceived(m_frame);
          }
          readMoment();
        });
      });
}

void ReplayController::load() {
  m_loaded = 0.0;
  emit loadedChanged(m_loaded);
  m_loader.start([this, path = m_path, file = m_file, rows = m_file->rows, mine = ++m_loading] {
    const auto reportProgress = [this, mine](double part) {
      m_toUi.post([this, part, mine] {
        if (mine != m_loading) return;
        m_loaded = part;
        emit loadedChanged(part);
        if (part < 1.0) return;
        noteWhatDoesNotFit();
        emit rowsCame();
      });
    };
    const QStringList damage =
        readRows(path, *rows, file->read, [this, mine, &reportProgress](double part) {
          if (part < 1.0) reportProgress(part);
          return mine == m_loading;
        });
    reportProgress(1.0);
    if (damage.isEmpty()) return;
    m_toUi.post([this, damage, mine] {
      if (mine == m_loading && !m_file->broken) emit damageFound(damage);
    });
  });
}

void ReplayController::page() {
  m_loaded = 0.0;
  emit loadedChanged(m_loaded);
  m_loader.start([this, path = m_path, file = m_file, budget = m_budget, mine = ++m_loading] {
    auto reader = telemetry::SessionReader::open(path.toStdString());
    m_toUi.post(
        [this, file, budget, mine, reader = std::make_shared<decltype(reader)>(std::move(reader))] {
          if (mine != m_loading) return;
          if (*reader) {
            for (const telemetry::SessionGroup& group : (*reader)->groups()) {
              (void)file->rows->addGroup(shownGroup(group));
            }
            m_pages = std::make_shared<ReplayPages>(std::move(**reader), budget);
            file->rows->setPages(m_pages);
            m_pages->setListener([this] { m_toUi.post([this] { emit rowsCame(); }); });
          }
          m_loaded = 1.0;
          emit loadedChanged(m_loaded);
        });
  });
}

void ReplayController::keepBookmark(const link::MatchEvent& bookmark) {
  if (!m_file) return;
  const auto kept =
      telemetry::addSessionNote(recording().toStdString(), bookmark.time, bookmark.detail);
  if (kept) return;
  QString reason = QString::fromStdString(kept.error().text());
  if (!reason.endsWith(QLatin1Char('.'))) reason += QLatin1Char('.');
  emit notKept(QStringLiteral("The bookmark will be lost: %1 Open a copy of the recording in a "
                              "folder that you can write to.")
                   .arg(reason));
}

void ReplayController::setMemoryBudget(std::size_t bytes) {
  m_budget = bytes;
  if (m_file) m_file->rows->setMemoryBudget(bytes);
  if (m_pages) m_pages->setBytes(bytes);
}

void ReplayController::noteWhatDoesNotFit() {
  constexpr double chunk = 1.0;  // s; groups do not begin all at once
  const auto held = m_file ? m_file->rows->range() : std::nullopt;
  // Robots may have come later than events and datagrams.
  if (!held || held->begin <= m_file->read.first + chunk) return;
  emit noted(
      {QStringLiteral(
           "The session does not fit into memory (%1 MB), so plots show its last %2. You can still "
           "view every moment. To load more, raise Timeline > Memory for the past…")
           .arg(m_budget >> 20)
           .arg(durationText(held->end - held->begin))});
}

}  // namespace pitchboard::ui
