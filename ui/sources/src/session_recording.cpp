// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/session_recording.h>

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>
#include <QTimer>
#include <algorithm>
#include <iterator>

#include <robotlink/scenario/scenario.h>
#include <robotlink/session/live_recorder.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

const QString folderKey = QStringLiteral("session/folder");
const QString recordingsKey = QStringLiteral("recordings/");  // by the process that records
constexpr std::size_t maxLogLines = 10'000;

QString textOf(const Error& error) {
  return QString::fromStdString(error.text());
}

/// Whether this process is a studio that runs, rather than another program that got the number of
/// one that was killed.
bool isStudio(qint64 process) {
  const QString exe = QStringLiteral("/proc/%1/exe");
  const QString own = QFile::symLinkTarget(exe.arg(QCoreApplication::applicationPid()));
  return process != QCoreApplication::applicationPid() &&
         QFile::symLinkTarget(exe.arg(process)) == own;
}

std::string programName() {
  return ("pitchboard " + QCoreApplication::applicationVersion()).trimmed().toStdString();
}

}  // namespace

QString freePath(const QString& path) {
  const QFileInfo wanted(path);
  const QString suffix = wanted.suffix().isEmpty() ? QString() : QLatin1Char('.') + wanted.suffix();
  QString found = path;
  for (int n = 2; QFile::exists(found); ++n) {
    found = wanted.dir().filePath(
        QStringLiteral("%1 (%2)%3").arg(wanted.completeBaseName()).arg(n).arg(suffix));
  }
  return found;
}

QString sessionFileName(const QDir& folder, const QString& title, const QDateTime& when) {
  const QString asked = title.simplified().left(60);
  QString name;
  for (qsizetype i = 0; i < asked.size(); ++i) {
    if (asked[i].isLetterOrNumber() || QStringLiteral(" -_").contains(asked[i]))
      name += asked[i];
    else if (i + 1 < asked.size() && asked[i + 1] != QLatin1Char(' '))
      name += QLatin1Char('-');  // else a space divides already: "Kick-off: 4 against 4"
  }
  if (name.isEmpty()) name = QStringLiteral("session");
  return freePath(
      folder.filePath(QStringLiteral("%1 %2.mcap")
                          .arg(name, when.toString(QStringLiteral("yyyy-MM-dd HH.mm.ss")))));
}

SessionRecording::SessionRecording(MatchController* controller, LiveController* live,
                                   ShownMoment* shown, QSettings* settings, QObject* parent)
    : QObject(parent),
      m_controller(controller),
      m_live(live),
      m_shown(shown),
      m_settings(settings),
      m_timer(new QTimer(this)) {
  constexpr int healthMilliseconds = 500;
  m_timer->setInterval(healthMilliseconds);
  connect(m_timer, &QTimer::timeout, this, &SessionRecording::checkHealth);
  connect(controller, &MatchController::ending, this, [this] {
    if (!m_recorder || m_recorder->live) return;
    m_endedPath = m_path;
    finish(true);
  });
  connect(controller, &MatchController::preparing, this, &SessionRecording::goOn);
  connect(controller, &MatchController::opened, this, [this] {
    if (m_recorder && !m_recorder->live && !m_controller->isOpen()) finish(true);
    emit changed();
  });
  connect(controller, &MatchController::scenarioChanged, this, [this] {
    m_log.clear();
    m_endedPath.clear();
    emit changed();
  });
  connect(shown, &ShownMoment::sourceChosen, this, &SessionRecording::changed);
  connect(controller, &MatchController::logReceived, this,
          [this](const std::vector<LogLine>& lines) {
            for (const LogLine& line : lines) {
              m_log.push_back(line);
              if (m_log.size() > maxLogLines) m_log.pop_front();
            }
          });
  connect(shown, &ShownMoment::bookmarked, this, [this](const link::MatchEvent& event) {
    if (!m_recorder || m_recorder->live != (m_shown->source() == m_live)) return;
    m_recorder->append(event);
  });
}

const FrameSource* SessionRecording::source() const {
  if (!m_recorder) return nullptr;
  return sourceOf(m_recorder->live);
}

const FrameSource* SessionRecording::sourceOf(bool live) const {
  return live ? static_cast<const FrameSource*>(m_live) : m_controller;
}

SessionRecording::~SessionRecording() {
  const QSignalBlocker nobodyIsLeftToHear(this);
  end();
}

void SessionRecording::end() {
  finish(false);
  m_worker.waitForDone();
  // What the worker says of its files waits for an event loop that may have ended.
  m_toUi.deliver();
}

QString SessionRecording::folder() const {
  QString chosen = m_settings->value(folderKey).toString();
  if (!chosen.isEmpty()) return chosen;
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  return QDir(documents).filePath(QStringLiteral("Pitchboard"));
}

void SessionRecording::setFolder(const QString& folder) {
  m_settings->setValue(folderKey, folder);
}

bool SessionRecording::isPossible() const {
  if (m_shown->source() == m_live) return m_live->isListening();
  return m_shown->source() == m_controller && m_controller->isOpen();
}

QString SessionRecording::newPath(const QString& title) {
  const QDir place(folder());
  return makeFolder(place) ? sessionFileName(place, title, QDateTime::currentDateTime())
                           : QString();
}

bool SessionRecording::makeFolder(const QDir& folder) {
  if (folder.mkpath(QStringLiteral("."))) return true;
  emit failed(
      QStringLiteral("Cannot record: could not create the folder %1. Choose another folder in "
                     "Timeline > Folder for recordings…")
          .arg(folder.path()));
  return false;
}

QString SessionRecording::title() const {
  return m_shown->source() == m_live ? QStringLiteral("live") : matchTitle();
}

QString SessionRecording::matchTitle() const {
  const link::Scenario& scenario = m_controller->scenario();
  return QString::fromStdString(scenario.title.empty() ? scenario.name : scenario.title);
}

Result<SessionRecording::Recorder> SessionRecording::recordMatch(
    const QString& path, std::vector<std::shared_ptr<link::TickObserver>>* observers) {
  link::RecorderOptions options;
  options.program = programName();
  options.writer = m_writing;
  auto made = link::MatchRecorder::create(path.toStdString(), m_controller->scenario(),
                                          m_controller->catalog(),
                                          m_controller->memory()->sampler(), options);
  if (!made) return tl::unexpected(made.error());
  const std::shared_ptr<link::MatchRecorder> recorder = *made;
  if (observers != nullptr)
    observers->push_back(recorder);
  else
    m_controller->observe(recorder);
  return Recorder{false, [recorder] { return recorder->status(); },
                  [recorder](const link::MatchEvent& event) { recorder->append(event); },
                  [controller = m_controller, recorder] {
                    if (controller) controller->stopObserving(recorder);
                  },
                  [recorder] { return recorder->finish(); }};
}

Result<SessionRecording::Recorder> SessionRecording::recordLive(const QString& path) {
  link::RecorderOptions options;
  options.program = programName();
  options.writer = m_writing;
  auto made =
      link::LiveRecorder::create(path.toStdString(), m_live->options(), m_live->began(), options);
  if (!made) return tl::unexpected(made.error());
  const std::shared_ptr<link::LiveRecorder> recorder = *made;
  m_live->observe(recorder);
  return Recorder{true, [recorder] { return recorder->status(); },
                  [recorder](const link::MatchEvent& event) { recorder->append(event); },
                  [live = m_live, recorder] {
                    if (live) live->stopObserving(recorder);
                  },
                  [recorder] { return recorder->finish(); }};
}

void SessionRecording::start() {
  if (m_recorder || !isPossible()) return;
  const QString path = newPath(title());
  if (!path.isEmpty()) begin(path);
}

void SessionRecording::startInto(const QString& path) {
  if (m_recorder) return;
  if (!isPossible()) {
    emit failed(QStringLiteral("Cannot record: no match is open."));
    return;
  }
  if (!makeFolder(QFileInfo(path).dir())) return;
  const QString unused = freePath(path);
  begin(unused);
  if (m_recorder && unused != path) {
    emit noted(QStringLiteral("%1 already exists; recording into %2 instead.").arg(path, unused));
  }
}

// The match that replaces a recorded one is recorded from its first tick.
void SessionRecording::goOn(std::vector<std::shared_ptr<link::TickObserver>>& observers) {
  if (m_endedPath.isEmpty()) return;
  const QString ended = std::exchange(m_endedPath, {});
  begin(sessionFileName(QFileInfo(ended).dir(), matchTitle(), QDateTime::currentDateTime()),
        &observers);
}

void SessionRecording::keepPath(const QString& path) {
  const QString key = recordingsKey + QString::number(QCoreApplication::applicationPid());
  if (path.isEmpty())
    m_settings->remove(key);
  else
    m_settings->setValue(key, path);
  m_settings->sync();  // the studio may be killed before it would happen by itself
}

QStringList SessionRecording::drainLost() {
  QStringList lost;
  m_settings->beginGroup(recordingsKey.chopped(1));
  for (const QString& process : m_settings->childKeys()) {
    if (isStudio(process.toLongLong())) continue;
    const QString path = m_settings->value(process).toString();
    if (QFile::exists(path)) lost << path;
    m_settings->remove(process);
  }
  m_settings->endGroup();
  return lost;
}

void SessionRecording::begin(const QString& path,
                             std::vector<std::shared_ptr<link::TickObserver>>* observers) {
  const bool live = observers == nullptr && m_shown->source() == m_live;
  auto made = live ? recordLive(path) : recordMatch(path, observers);
  if (!made) {
    emit failed(
        QStringLiteral("Cannot record: %1. The folder is set in Timeline > Folder for recordings…")
            .arg(textOf(made.error())));
    return;
  }
  m_recorder = std::move(*made);
  m_path = path;
  keepPath(path);
  m_reported.clear();
  m_timer->start();
  emit began();
  emit changed();
}

void SessionRecording::stop() {
  finish(false);
}

void SessionRecording::finish(bool matchEnds) {
  if (!m_recorder) return;
  const Recorder recorder = *std::exchange(m_recorder, std::nullopt);
  m_timer->stop();
  keepPath({});
  recorder.detach();
  m_worker.start([this, recorder, path = m_path, matchEnds] {
    const auto done = recorder.finish();
    m_toUi.post([this, done, path, matchEnds, isLive = recorder.live] {
      if (!done) {
        emit failed(
            QStringLiteral(
                "The recording %1 is incomplete: %2. You can open the part that was written.")
                .arg(path, textOf(done.error())));
        return;
      }
      emit saved(path, sourceOf(isLive));
      if (!matchEnds) return;
      emit noted(m_recorder && !m_recorder->live
                     ? QStringLiteral("Another match began, so recording continues in %1. The file "
                                      "of the match before is complete: %2")
                           .arg(m_path, path)
                     : QStringLiteral("The recording ended with the match: %1").arg(path));
    });
  });
  emit changed();
}

telemetry::SessionStatus SessionRecording::status() const {
  return m_recorder ? m_recorder->status() : telemetry::SessionStatus{};
}

void SessionRecording::checkHealth() {
  if (!m_recorder) return;
  const telemetry::SessionStatus status = m_recorder->status();
  QString problem = QString::fromStdString(status.problem);
  // A file that was removed goes on being written, to nowhere.
  if (problem.isEmpty() && !QFile::exists(m_path)) {
    problem = QStringLiteral("Recording stopped. The file %1 was removed or its folder is gone.")
                  .arg(m_path);
  }
  if (problem.isEmpty()) {
    warnOf(status);
    return;
  }
  const Recorder recorder = *std::exchange(m_recorder, std::nullopt);
  m_timer->stop();
  keepPath({});
  recorder.detach();
  m_worker.start([recorder] { static_cast<void>(recorder.finish()); });
  emit failed(problem);
  emit changed();
}

// Once for each kind; the status bar says it all the time.
void SessionRecording::warnOf(const telemetry::SessionStatus& status) {
  const telemetry::RecordingTrouble trouble = telemetry::troubleOf(status);
  if (trouble == telemetry::RecordingTrouble::None || !m_reported.insert(trouble).second) return;
  emit noted(QString::fromStdString(telemetry::troubleText(status)));
}

SessionMaker SessionRecording::recentPast(double seconds) const {
  const auto rows = m_shown->series();
  const bool live = m_shown->source() == m_live;
  if (!rows || !rows->range() || !m_shown->kind().hasPresent) return {};
  link::RecentPast past;
  const auto& events = m_shown->events()->events();
  std::ranges::remove_copy_if(events, std::back_inserter(past.events), isMadeByStudio);
  std::vector<telemetry::DrawnNote> notes;
  if (m_drawnNotes) notes = m_drawnNotes(m_shown->source());
  std::erase_if(notes, [begin = rows->range()->end - seconds](const telemetry::DrawnNote& note) {
    return note.time + note.duration < begin;
  });
  std::shared_ptr<const link::StateArchive> archive;
  std::shared_ptr<const link::LiveMemory> received;
  std::shared_ptr<const link::LiveHistory> drawn;
  telemetry::SessionInfo about;
  if (live) {
    about = link::liveSessionInfo(m_live->options(), m_live->began(), programName());
    past.profile = telemetry::profileText(m_live->options().profile);
    received = m_live->memory();
  } else {
    link::RecorderOptions options;
    options.program = programName();
    about = link::sessionInfo(m_controller->scenario(), options);
    past.log.assign(m_log.begin(), m_log.end());
    past.scenario = link::scenarioToJson(m_controller->scenario());
    past.catalog = m_controller->catalog().toJson();
    archive = m_controller->memory()->archive();
    drawn = m_controller->memory()->drawn();
  }
  return [past = std::move(past), notes = std::move(notes), rows, archive, received, drawn, about,
          seconds](const QString& path) -> Result<void> {
    link::RecentPast all = past;
    all.rows = rows.get();
    all.archive = archive.get();
    all.received = received.get();
    all.drawn = drawn.get();
    const auto done = link::saveRecent(path.toStdString(), seconds, all, about);
    if (!done) return tl::unexpected(done.error());
    return telemetry::writeDrawnNotes(path.toStdString(), notes);
  };
}

void SessionRecording::saveLast(double seconds) {
  SessionMaker make = recentPast(seconds);
  if (!make) {
    emit failed(QStringLiteral("There is nothing in memory to save yet."));
    return;
  }
  const QString path = newPath(title() + QStringLiteral(" last %1 s").arg(seconds));
  if (path.isEmpty()) return;
  m_worker.start([this, path, make = std::move(make), isLive = m_shown->source() == m_live] {
    const auto done = make(path);
    m_toUi.post([this, done, path, isLive] {
      if (done)
        emit saved(path, sourceOf(isLive));
      else
        emit failed(QStringLiteral("Could not save: %1").arg(textOf(done.error())));
    });
  });
}

}  // namespace pitchboard::ui
