// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/session/session_files.h>

#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <algorithm>
#include <utility>

#include <telemetry/session/session_repair.h>
#include <ui/base/file_dialog.h>
#include <ui/base/notice_bar.h>
#include <ui/base/robot_text.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/scenario_behind.h>
#include <ui/sources/shown_moment.h>

#include "follow_dialog.h"
#include "join_dialog.h"
#include "recording_import.h"

namespace pitchboard::ui {
namespace {

using Poses = link::MomentOptions::Poses;

const QString suffix = QStringLiteral("mcap");
const QString sessionFilter = QStringLiteral("Sessions (*.mcap);;All files (*)");

QStringList droppedSessions(const QMimeData* data) {
  QStringList paths;
  for (const QUrl& url : data->urls()) {
    if (!url.isLocalFile()) continue;
    const QString path = url.toLocalFile();
    const bool isSession = QFileInfo(path).suffix().toLower() == suffix;
    if (isSession || RecordingImport::isOfOthers(path)) paths << path;
  }
  return paths;
}

// Topics of notices.
const QString openTopic = QStringLiteral("session"), repairTopic = QStringLiteral("repair"),
              repairedTopic = QStringLiteral("repaired"),
              contentTopic = QStringLiteral("session content"),
              notesTopic = QStringLiteral("session notes"), importTopic = QStringLiteral("import"),
              simulateTopic = QStringLiteral("simulate from here");

QString brokenText(const QString& path) {
  return QStringLiteral(
             "%1 is truncated or damaged. The readable part is shown. You can repair it into a new "
             "file.")
      .arg(QFileInfo(path).fileName());
}

QString growingText(const QString& path) {
  return QStringLiteral(
             "%1 is still being recorded. You see what was recorded until now; open it again for "
             "the rest.")
      .arg(QFileInfo(path).fileName());
}

QString repairedName(const QString& path) {
  const QFileInfo file(path);
  const QString base = file.dir().filePath(file.completeBaseName() + QStringLiteral(" repaired"));
  QString name = base + QStringLiteral(".mcap");
  for (int n = 2; QFile::exists(name); ++n) name = QStringLiteral("%1 (%2).mcap").arg(base).arg(n);
  return name;
}

}  // namespace

SessionFiles::SessionFiles(ReplayController* replay, MatchController* controller,
                           ShownMoment* shown, NoticeBar* notices, QWidget* window)
    : QObject(window),
      m_replay(replay),
      m_controller(controller),
      m_shown(shown),
      m_notices(notices),
      m_window(window),
      m_import(new RecordingImport(window)) {
  window->setAcceptDrops(true);
  window->installEventFilter(this);
  // What is told of one file goes with it.
  connect(replay, &ReplayController::restarted, this, [this] {
    for (const QString& topic : {openTopic, repairTopic, contentTopic, notesTopic})
      m_notices->settle(topic);
  });
  connect(replay, &ReplayController::failed, this, [this](const QString& sentence) {
    m_before.clear();
    m_notices->show({openTopic}, sentence);
    openBeside();
  });
  connect(replay, &ReplayController::foreignFound, this,
          [this](const QString& path) { importWith({path}, {}); });
  connect(m_import, &RecordingImport::imported, this, &SessionFiles::showImported);
  connect(m_import, &RecordingImport::failed, this,
          [this](const QString& sentence) { m_notices->show({importTopic}, sentence); });
  connect(shown, &ShownMoment::bookmarked, this, [this](const link::MatchEvent& event) {
    if (m_shown->source() == m_replay) m_replay->keepBookmark(event);
  });
  connect(replay, &ReplayController::notKept, this,
          [this](const QString& sentence) { m_notices->show({notesTopic}, sentence); });
  connect(replay, &ReplayController::opened, this, [this] {
    const QString before = std::exchange(m_before, QString());
    if (!before.isEmpty() && before != m_replay->recording()) emit replaced();
    m_shown->choose(m_replay);
    showTitle();
    openBeside();
    if (m_replay->isBroken()) offerRepair(brokenText(m_replay->path()));
    if (m_replay->isGrowing()) m_notices->show({contentTopic}, growingText(m_replay->path()));
  });
  connect(shown, &ShownMoment::restarted, this, &SessionFiles::showTitle);
  // They would be taken for the match, or for what is received.
  connect(shown, &ShownMoment::sourceChosen, this, [this] {
    const bool isShown = m_shown->source() == m_replay;
    if (!isShown) {
      for (const QString& topic : {openTopic, repairTopic, contentTopic, importTopic})
        m_notices->settle(topic);
      return;
    }
    if (m_replay->isBroken()) offerRepair(brokenText(m_replay->path()));
  });
  connect(replay, &ReplayController::damageFound, this, [this](const QStringList& sentences) {
    offerRepair(QStringLiteral("Part of %1 is damaged; the rest is shown. %2")
                    .arg(QFileInfo(m_replay->path()).fileName(), shortened(sentences)));
  });
  connect(replay, &ReplayController::noted, this, [this](const QStringList& sentences) {
    // The offer must not wait behind the reason for it.
    if (m_replay->isBroken())
      offerRepair(brokenText(m_replay->path()) + QLatin1Char(' ') + shortened(sentences));
    else if (m_replay->isGrowing())
      m_notices->show({contentTopic},
                      growingText(m_replay->path()) + QLatin1Char(' ') + shortened(sentences));
    else
      m_notices->show({contentTopic}, shortened(sentences));
  });
}

SessionFiles::~SessionFiles() {
  m_cancelled = true;
  m_worker.waitForDone();
}

void SessionFiles::showTitle() {
  QString file =
      m_shown->source() == m_replay ? QFileInfo(m_replay->recording()).fileName() : QString();
  if (!file.isEmpty() && m_replay->recording() != m_replay->path())
    file += QStringLiteral(" with a rerun");
  const QString program = QStringLiteral("Pitchboard");
  m_window->setWindowTitle(file.isEmpty() ? program : QStringLiteral("%1 — %2").arg(file, program));
}

QString SessionFiles::shortened(const QStringList& sentences) {
  constexpr int most = 3;
  QString text = sentences.mid(0, most).join(QLatin1Char(' '));
  if (sentences.size() > most) text += QStringLiteral(" And %1 more.").arg(sentences.size() - most);
  return text;
}

void SessionFiles::offerRepair(const QString& sentence) {
  m_notices->show({repairTopic}, sentence,
                  {{QStringLiteral("Repair into a new file"),
                    [this, path = m_replay->path()] { repair(path); }},
                   {QStringLiteral("Not now"), {}}});
}

void SessionFiles::showImported(const QString& recording, const QString& session,
                                const QStringList& notes) {
  QString text = QStringLiteral(
                     "%1 was imported. The session is temporary: keep it with "
                     "Timeline > Export….")
                     .arg(QFileInfo(recording).fileName());
  if (!notes.isEmpty()) text += QLatin1Char(' ') + shortened(notes);
  m_imported = std::exchange(m_importing, {});
  m_importedSession = session;
  std::vector<NoticeButton> buttons;
  if (!m_imported.isEmpty()) {
    buttons.push_back({QStringLiteral("Map topics…"),
                       [this, recordings = m_imported] { emit mappingWanted(recordings); }});
    buttons.push_back({QStringLiteral("Close"), {}});
  }
  m_notices->show({importTopic}, text, buttons);
  m_before = m_replay->recording();
  m_replay->open(session);
}

void SessionFiles::openAll(const QStringList& paths) {
  // Of one match: they are put on one clock first.
  if (paths.size() > 1 && std::ranges::any_of(paths, &RecordingImport::isOfOthers)) {
    emit mappingWanted(paths);
    return;
  }
  open(paths.front());
  m_beside = paths.mid(1);
}

/// The others of several files that were dropped at once.
void SessionFiles::openBeside() {
  const QStringList others = std::exchange(m_beside, {});
  if (!others.isEmpty()) emit besideRequested(others);
}

void SessionFiles::importWith(const QStringList& recordings, const QString& mappingFile) {
  m_importing = recordings;
  m_import->start(recordings, mappingFile);
}

QStringList SessionFiles::importedRecordings() const {
  return m_replay->path() == m_importedSession ? m_imported : QStringList();
}

void SessionFiles::open(const QString& path) {
  m_beside.clear();
  m_notices->settle(repairedTopic);
  m_notices->settle(importTopic);
  if (RecordingImport::isOfOthers(path)) return importWith({path}, {});
  m_before = m_replay->recording();
  m_replay->open(path);
}

void SessionFiles::askAndOpen() {
  const QString path = askForFile(QStringLiteral("Open session"));
  if (!path.isEmpty()) open(path);
}

void SessionFiles::askAndJoin() {
  const QString path = askForFile(QStringLiteral("Add recording of a robot"));
  if (!path.isEmpty()) askHowToJoin(path);
}

void SessionFiles::askHowToJoin(const QString& recording) {
  const QString session = m_replay->path();
  auto* dialog = new JoinDialog(session, recording, m_window,
                                [this, session, recording](const link::JoinOptions& options) {
                                  m_importing.clear();
                                  m_import->join(session, recording, options);
                                });
  dialog->open();
}

QString SessionFiles::askForFile(const QString& title) {
  return askToOpen(m_window, title, sessionFilter);
}

QStringList SessionFiles::askForFiles(const QString& title) {
  return askToOpenSeveral(m_window, title, sessionFilter);
}

void SessionFiles::repair(const QString& path) {
  const QString to = repairedName(path);
  ++m_repairs;
  m_worker.start([this, path, to] {
    const auto report = telemetry::repairSession(path.toStdString(), to.toStdString(),
                                                 [this](double) { return !m_cancelled; });
    m_toUi.post([this, report, to] {
      --m_repairs;
      if (!report) {
        m_notices->show({repairTopic}, QStringLiteral("Could not repair the session: %1")
                                           .arg(QString::fromStdString(report.error().text())));
        return;
      }
      QString text =
          QStringLiteral("Repaired into %1: %2").arg(to, QString::fromStdString(report->summary()));
      if (!report->notes.empty()) {
        QStringList notes;
        for (const std::string& note : report->notes) notes << QString::fromStdString(note);
        text += QLatin1Char(' ') + shortened(notes);
      }
      m_notices->show({repairedTopic}, text);
      m_replay->open(to);
    });
  });
}

bool SessionFiles::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::DragEnter) {
    auto* drag = static_cast<QDragEnterEvent*>(event);
    if (!droppedSessions(drag->mimeData()).isEmpty()) {
      drag->acceptProposedAction();
      return true;
    }
  }
  if (event->type() == QEvent::Drop) {
    auto* drop = static_cast<QDropEvent*>(event);
    const QStringList paths = droppedSessions(drop->mimeData());
    if (!paths.isEmpty()) {
      drop->acceptProposedAction();
      openAll(paths);
      return true;
    }
  }
  return QObject::eventFilter(watched, event);
}

void SessionFiles::simulateFromHere(link::MomentOptions::Poses poses) {
  simulateFrom(m_shown->frame(), poses, {});
}

void SessionFiles::askAndFollow() {
  const FramePtr frame = m_shown->frame();
  if (!frame || frame->robots.empty()) return simulateFrom(frame, Poses::True, {});
  QStringList names{QStringLiteral("ball")}, opponents = names;
  const TeamColor ours = frame->robots.front().identity.team;
  for (const link::RobotFrame& robot : frame->robots) {
    names << QString::fromStdString(robot.identity.name());
    if (robot.identity.team != ours) opponents << names.back();
  }
  auto* dialog = new FollowDialog(
      names, opponents, m_window, [this, frame](const QStringList& who, double reach) {
        link::FollowOptions follow;
        for (const QString& name : who) follow.who.push_back(name.toStdString());
        follow.reach = reach;
        simulateFrom(frame, frame->truthKnown ? Poses::True : Poses::Believed, follow);
      });
  dialog->open();
}

/// Returns what follows that frame, of the source that is shown; null if it does not tell.
Result<std::shared_ptr<const link::FollowedRecording>> SessionFiles::recordingAfter(
    const link::MatchFrame& frame, const link::Scenario& scenario,
    link::FollowOptions options) const {
  if (options.who.empty()) return nullptr;
  constexpr double longest = 60.0;  // s
  const FrameSource* source = m_shown->source();
  const auto range = source->available();
  options.from = frame.snapshot.time;
  options.until = std::min(range ? range->end : options.from, options.from + longest);
  auto recording = link::recordingToFollow([source](double time) { return source->frameAt(time); },
                                           scenario, options);
  if (!recording) return tl::unexpected(recording.error());
  return std::make_shared<const link::FollowedRecording>(std::move(*recording));
}

void SessionFiles::simulateFrom(const FramePtr& frame, Poses poses,
                                const link::FollowOptions& follow) {
  const auto refuse = [this](const QString& why) {
    m_notices->show({simulateTopic}, QStringLiteral("Cannot simulate from here: %1").arg(why));
  };
  if (!frame || frame->robots.empty()) {
    return refuse(QStringLiteral("no robot is on the field."));
  }
  link::MomentOptions options;
  options.poses = poses;
  options.catalog = &m_controller->catalog();
  options.ball =
      poses == Poses::True ? link::MomentOptions::Ball::True : link::MomentOptions::Ball::Perceived;
  const auto base = scenarioBehind(*m_shown, *m_controller, *m_replay);
  if (base) options.base = &*base;
  const link::MomentScenario moment = link::scenarioFromMoment(*frame, options);
  const auto recording = recordingAfter(*frame, moment.scenario, follow);
  if (!recording) return refuse(QString::fromStdString(recording.error().message));
  m_shown->goLive();
  m_shown->choose(m_controller);
  const QString when = clockText(frame->snapshot.time);
  // Paused until it follows: not a tick is played freely.
  m_controller->edits()->replaceMatch(moment.scenario, QStringLiteral("Simulate from %1").arg(when),
                                      QStringLiteral("Simulating from %1").arg(when),
                                      *recording != nullptr);
  if (*recording) {
    m_controller->post([recording = *recording](link::SimulatedMatch& match) {
      match.follow(recording);
      return link::Changed::No;
    });
    m_controller->setPaused(false);
  }
  QStringList notes;
  for (const std::string& note : moment.notes) notes << QString::fromStdString(note);
  m_notices->settle(simulateTopic);
  if (!notes.isEmpty()) m_notices->show({simulateTopic}, notes.join(QLatin1Char(' ')));
}

void SessionFiles::continueFromHere() {
  if (!m_shown->kind().mayBeContinued || !m_shown->isLookingBack()) return;
  const double time = m_shown->time();
  m_controller->memory()->continueFrom(time);
  m_shown->goLive();
}

}  // namespace pitchboard::ui
