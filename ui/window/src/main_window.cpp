// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/window/main_window.h>

#include <QAbstractScrollArea>
#include <QApplication>
#include <QDialog>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <telemetry/series/group_order.h>
#include <ui/base/file_dialog.h>
#include <ui/base/notice_bar.h>
#include <ui/base/plot_target.h>
#include <ui/base/robot_text.h>
#include <ui/base/time_axis.h>
#include <ui/base/undo_history.h>
#include <ui/base/wheel_guard.h>
#include <ui/experiments/situation_tests.h>
#include <ui/explore/explorer.h>
#include <ui/field/field_view.h>
#include <ui/plots/film_curves.h>
#include <ui/plots/plots_dock.h>
#include <ui/processes/orphan_notice.h>
#include <ui/rerun/rerunner.h>
#include <ui/session/export_dialog.h>
#include <ui/session/session_files.h>
#include <ui/share/network_share.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/attached_boards.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/live_overlay.h>
#include <ui/sources/live_settings.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/note_board.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/rule_watch.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/timeline/timeline_actions.h>
#include <ui/video/video_dock.h>
#include <ui/window/scenario_files.h>

#include "alarms.h"
#include "command_palette.h"
#include "dock_list.h"
#include "dock_title.h"
#include "field_only.h"
#include "field_signs.h"
#include "help_windows.h"
#include "key_map.h"
#include "menu_actions.h"
#include "menus.h"
#include "scenario_chooser.h"
#include "status_bar.h"
#include "studio_parts.h"
#include "tab_corner.h"
#include "transport_bar.h"

namespace pitchboard::ui {
namespace {
const QString exportTopic = QStringLiteral("export");
const QString speedTopic = QStringLiteral("speed");
const QString memoryKey = QStringLiteral("session/memoryMegabytes");
constexpr int maxMemory = 65536;
const QString recentSessionsKey = QStringLiteral("sessions/recent");
}  // namespace

MainWindow::MainWindow(MatchController* controller, QSettings* settings, QWidget* parent)
    : QMainWindow(parent),
      m_controller(controller),
      m_live(new LiveController(this)),
      m_settings(settings),
      m_shown(new ShownMoment(controller, this)),
      m_undo(new UndoHistory(this)),
      m_selection(new RobotSelection(this)),
      m_time(new LinkedTime(m_shown, this)),
      m_plots(new PlotTarget(this)),
      m_future(new AbandonedFuture(controller, m_shown, this)),
      m_replay(new ReplayController(this)),
      m_recording(new SessionRecording(controller, m_live, m_shown, settings, this)),
      m_timelineActions(new TimelineActions(m_shown, m_time, m_future, this)),
      m_boards(new AttachedBoards(controller, m_live, m_shown, settings, this)) {
  guardWheel(*qApp);
  m_shown->add(m_live);
  m_shown->add(m_replay);
  m_shown->setTimesOfDay(settings->value(QStringLiteral("view/timesOfDay"), true).toBool());
  m_noteBoard = new NoteBoard(m_shown, controller, m_replay, m_recording, this);
  m_undo->add(controller->edits()->undoStack(),
              [this] { return m_shown->kind().canBeEdited && !m_shown->isLookingBack(); });
  connect(controller->edits(), &MatchEdits::sent, m_undo, &UndoHistory::expect);
  connect(controller->edits(), &MatchEdits::answered, m_undo, &UndoHistory::answer);
  m_undo->add(m_noteBoard->undoStack(), [] { return true; });
  setWindowTitle(QStringLiteral("Pitchboard"));
  // A title drags its own panel: of a group of tabs Qt neither asks where it may be dropped nor
  // says where it was.
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  setContextMenuPolicy(Qt::PreventContextMenu);

  auto* centre = new QWidget(this);
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  m_notices = new NoticeBar(centre);
  m_field = new FieldView(m_shown, controller, centre);
  m_field->showNotes(m_noteBoard);
  m_overlay = new LiveOverlay(controller, m_live, m_shown, this);
  m_compared = new ComparedSessions(m_shown, this);
  column->addWidget(m_field, 1);
  m_notices->floatOver(centre);
  setCentralWidget(centre);
  m_fieldOnly = new FieldOnly(this, m_shown);
  m_alarms = new Alarms(m_shown, centre, settings, this);
  m_rules = new RuleWatch(m_shown, m_replay, m_compared, settings, this);
  connect(m_rules, &RuleWatch::broke, m_alarms, &Alarms::raiseForRule);

  m_sessions = new SessionFiles(m_replay, controller, m_shown, m_notices, this);
  m_bar = new TransportBar({controller, m_shown, m_replay, m_recording, m_live}, settings, this);
  addToolBar(m_bar);
  m_share = new NetworkShare({controller, m_live, m_replay, m_shown}, this);
  m_status = new StudioStatusBar(
      {controller, m_shown, m_selection, m_replay, m_recording, m_live, m_share}, this);
  setStatusBar(m_status);
  m_files = new ScenarioFiles(controller, m_field, m_bar->scenarios(), this);
  m_tests = new SituationTests({m_shown, controller, m_replay, settings}, this);
  m_explorer = new Explorer({m_shown, controller, m_replay}, this);
  m_rerunner = new Rerunner({m_shown, m_replay, m_time, m_plots}, this);
  m_work.add(m_rerunner, [this] {
    return m_rerunner->isRunning() ? QStringLiteral("A rerun is running. Quitting cancels it.")
                                   : QString();
  });
  m_work.add(m_recording, [this] {
    return m_recording->isRecording()
               ? QStringLiteral("A recording is running. Quitting ends it and keeps the file %1.")
                     .arg(m_recording->path())
               : QString();
  });
  m_work.add(m_sessions, [this] {
    return m_sessions->isRepairing()
               ? QStringLiteral("A session is being repaired. Quitting cancels it.")
               : QString();
  });
  makeDocks();
  m_plotsDock = findChild<PlotsDock*>();
  new TabCorner(qobject_cast<QDockWidget*>(m_plotsDock->parentWidget()), m_plotsDock->pageTabs(),
                m_docks);
  m_undo->add(m_plotsDock->undoStack(), [] { return true; });
  const auto* video = findChild<QDockWidget*>(QStringLiteral("video"));
  m_undo->add(videoUndoStack(video->widget()), [] { return true; });
  connect(m_plotsDock, &PlotsDock::noted, m_status, &StudioStatusBar::note);
  makeMenus();
  makeKeys();
  m_bar->addReplayActions({m_keys->action("openSession"), m_keys->action("compareSession"),
                           m_keys->action("exportSession"), m_timelineActions->previous(),
                           m_timelineActions->next()});
  connectField();
  if (auto* canvas = m_field->findChild<QAbstractScrollArea*>()) {
    makeOpeningSign(controller, canvas);
    makeFinalWhistleSign(m_shown, canvas);
    makeLookingBackSign(m_shown, canvas);
    makeNobodyPlaysSign(m_shown, canvas);
    makePublishedKeysSign(m_field->actions().publishedKeys, canvas);
    makePenaltyStrip(m_shown, m_field, canvas);
    makeFirstSteps(m_shown, controller, {m_keys->action("play"), m_keys->action("showKeys")},
                   settings, canvas);
  }
  connectNotices();
  // What was compared belongs to the session before, unless that changes places with one of them.
  connect(m_sessions, &SessionFiles::replaced, m_compared, [this] {
    if (!m_compared->isInstead(m_replay->path())) m_compared->removeAll();
  });
  connect(m_compared, &ComparedSessions::openRequested, m_sessions, &SessionFiles::open);
  connect(m_sessions, &SessionFiles::besideRequested, m_compared, &ComparedSessions::open);
  connect(m_replay, &ReplayController::failed, m_compared, &ComparedSessions::forgetInstead);
  connect(m_replay, &ReplayController::opened, m_compared, [this] {
    if (m_compared->isInstead(m_replay->path())) m_compared->finishInstead();
  });
  connect(m_replay, &ReplayController::opened, this, [this] {
    QStringList recent = recentSessions();
    recent.removeAll(m_replay->recording());
    recent.prepend(m_replay->recording());
    rememberFolderOf(m_replay->recording());
    constexpr qsizetype most = 8;
    m_settings->setValue(recentSessionsKey, recent.mid(0, most));
  });
  connect(m_shown, &ShownMoment::sourceChosen, this, [this] { m_selection->set({}); });
  const auto lock = [this] {
    m_controller->edits()->setLocked(m_shown->kind().canBeEdited && m_shown->isLookingBack());
    m_undo->refresh();
  };
  connect(m_shown, &ShownMoment::lookingBackChanged, this, lock);
  connect(m_shown, &ShownMoment::sourceChanged, this, lock);
  connect(m_bar, &TransportBar::sourceRequested, this, &MainWindow::showSource);
  connect(m_bar->scenarios(), &ScenarioChooser::chosen, m_files, &ScenarioFiles::open);
  connect(m_bar->scenarios(), &ScenarioChooser::openRequested, m_files, &ScenarioFiles::askAndOpen);
  const LiveSettings live = loadLiveSettings(*settings);
  m_live->setOptions(live.options);
  if (!live.problem.isEmpty())
    m_notices->show({QStringLiteral("live")}, QStringLiteral("Live: %1").arg(live.problem));
  setMemoryBudget(memoryBudget());
  keepDialogFolderIn(m_settings, m_recording->folder());
  restoreLayout();
  constexpr int saveMilliseconds = 3000;
  auto* saving = new QTimer(this);
  connect(saving, &QTimer::timeout, this, &MainWindow::saveLayout);
  saving->start(saveMilliseconds);
  nameForScreenReaders();
  m_field->setFocus();
}

MainWindow::~MainWindow() {
  shutDown();
}

// The order in which everything ends: what is being written, while all it is made of is there; then
// what is seen; then what that shows. Left to themselves, children go by age, the oldest first, and
// those are the sources that everything else uses. The match itself outlives the window.
void MainWindow::shutDown() {
  delete m_undo;  // it asks what goes next
  m_recording->end();
  qDeleteAll(findChildren<QDialog*>(Qt::FindDirectChildrenOnly));
  delete m_sessions;

  delete m_overlay;
  delete m_compared;
  delete m_files;
  qDeleteAll(std::exchange(m_docks, {}));
  delete m_rules;
  delete m_explorer;
  delete m_rerunner;
  delete m_bar;
  delete m_status;
  delete m_share;
  delete m_notices;
  delete takeCentralWidget();

  delete m_noteBoard;
  delete m_recording;
  delete m_boards;
  delete m_timelineActions;
  delete m_future;
  delete m_time;
  delete m_shown;
  delete m_replay;
  delete m_live;
}

StudioParts MainWindow::parts() {
  return {m_controller, m_shown,           m_selection, m_field,     m_time,     m_settings,
          m_plots,      m_timelineActions, m_replay,    m_recording, m_live,     m_overlay,
          m_compared,   m_future,          m_tests,     m_boards,    m_explorer, m_rerunner,
          &m_work,      m_share,           m_rules,     m_sessions,  m_noteBoard};
}

QStringList MainWindow::recentSessions() const {
  QStringList files = m_settings->value(recentSessionsKey).toStringList();
  files.removeIf([](const QString& file) { return !QFileInfo::exists(file); });
  return files;
}

void MainWindow::askAndOpen() {
  const QString path =
      askToOpen(this, QStringLiteral("Open a scenario or a session"),
                QStringLiteral("Scenarios, sessions and recordings (*.json *.mcap *.db3 *.csv "
                               "*.tsv *.yaml *.yml);;All files (*)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().toLower() == QStringLiteral("json"))
    m_files->open(path);
  else
    openSession(path);
}

void MainWindow::showPalette() {
  std::vector<PaletteEntry> entries, deep;
  for (const MenuAction& each : menuActions(*menuBar())) {
    if (!each.action->isEnabled()) continue;
    // An action three menus deep is hardly meant if a variable has the same text.
    const bool isDeep = each.menu.count(QStringLiteral(": ")) > 1;
    (isDeep ? deep : entries)
        .push_back({QStringLiteral("%1: %2").arg(each.menu, each.text),
                    (each.action->isChecked() ? QStringLiteral("✓  ") : QString()) +
                        each.action->shortcut().toString(QKeySequence::NativeText),
                    [action = each.action] {
                      if (action) action->trigger();
                    }});
  }
  if (const FramePtr frame = m_shown->frame()) {
    for (const link::RobotFrame& robot : frame->robots) {
      entries.push_back({robotName(robot), QStringLiteral("robot"),
                         [this, id = robot.uid] { m_selection->set({id}); }});
    }
  }
  for (const QString& name : m_plotsDock->variables()) {
    entries.push_back(
        {name, QStringLiteral("plot"), [this, name] { m_plotsDock->plotVariables({name}); }});
  }
  entries.insert(entries.end(), deep.begin(), deep.end());
  const auto& events = m_shown->events()->events();
  constexpr int maxEvents = 500;
  int listed = 0;
  for (auto event = events.rbegin(); event != events.rend() && listed < maxEvents; ++event) {
    if (!link::isMarked(*event)) continue;
    ++listed;
    entries.push_back({QString::fromStdString(sentenceOf(*event)),
                       momentText(event->time, 1, m_shown->clock()),
                       [this, time = event->time] { m_shown->seek(time); }});
  }
  (new CommandPalette(std::move(entries), this))->show();
}

void MainWindow::makeMenus() {
  StudioMenus({parts(), m_undo, m_files, m_sessions, m_bar->scenarios(),
               m_bar->transportActions() + m_bar->skipActions(), m_bar->speedSteps(),
               [this] { showShortcuts(this, *m_keys); }, m_status, m_docks, m_fieldOnly, m_alarms},
              *this)
      .make();
}

void MainWindow::overlayLive(bool on) {
  m_overlay->setOn(on);
}

void MainWindow::openSession(const QString& path) {
  m_sessions->open(path);
}

void MainWindow::recordInto(const QString& path) {
  m_recording->startInto(path);
}

void MainWindow::showExport() {
  const auto all = m_shown->available();
  if (!all) {
    m_notices->show({exportTopic}, QStringLiteral("There is nothing to export yet."));
    return;
  }
  m_notices->settle(exportTopic);
  ExportSource source;
  if (m_shown->source() == m_replay) {
    const QFileInfo file(m_replay->path());
    source.session = m_replay->path();
    source.name = file.completeBaseName() + QStringLiteral(" part");
    source.groups = m_replay->groups();
  } else {
    source.make = [this] {
      return m_recording->recentPast(std::numeric_limits<double>::infinity());
    };
    source.name = m_shown->source() == m_live
                      ? QStringLiteral("live")
                      : QString::fromStdString(m_controller->scenario().title);
    if (const auto rows = m_shown->series()) {
      for (telemetry::GroupId id = 0; id < rows->groups(); ++id) {
        if (const auto view = rows->view(id)) source.groups.push_back(view->info());
      }
    }
  }
  std::ranges::stable_sort(source.groups, telemetry::isListedBefore);
  source.clock = m_shown->clock();
  constexpr int filmWidth = 1920;  // pixels
  if (m_plotsDock != nullptr) source.film.curves = filmCurves(*m_plotsDock, filmWidth);
  if (const auto* video = findChild<QDockWidget*>(QStringLiteral("video"))) {
    source.film.cameras = filmCameras(video->widget());
  }
  auto* dialog =
      new ExportDialog(std::move(source), m_shown->selection().value_or(*all), m_field, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  m_work.add(dialog, [dialog] {
    return dialog->isWriting() ? QStringLiteral("An export is running. Quitting cancels it.")
                               : QString();
  });
  dialog->show();
}

int MainWindow::memoryBudget() const {
  constexpr int usual = 1024;
  bool good = false;
  const int kept = m_settings->value(memoryKey, usual).toInt(&good);
  return good && kept >= 1 && kept <= maxMemory ? kept : usual;
}

void MainWindow::setMemoryBudget(int megabytes) {
  m_settings->setValue(memoryKey, std::clamp(megabytes, 1, maxMemory));
  const std::size_t bytes = static_cast<std::size_t>(memoryBudget()) << 20;
  m_controller->memory()->setMemoryBudget(bytes);
  m_live->setMemoryBudget(bytes);
  m_replay->setMemoryBudget(bytes);
  m_compared->setMemoryBudget(bytes);
}

void MainWindow::showSource(const SourceKind& kind) {
  FrameSource* source = m_shown->find(kind);
  if (source == nullptr) return;
  if (source == m_live) m_live->start();
  m_shown->choose(source);
}

void MainWindow::makeDocks() {
  const StudioParts parts = this->parts();
  for (const DockInfo& info : studioDocks()) {
    auto* dock = new QDockWidget(QString::fromUtf8(info.title), this);
    dock->setObjectName(QLatin1String(info.id));
    dock->setWidget(info.make(parts, dock));
    dock->setTitleBarWidget(new DockTitle(dock));
    // Above the field it would take the height that the field needs.
    dock->setAllowedAreas(Qt::LeftDockWidgetArea | Qt::RightDockWidgetArea |
                          Qt::BottomDockWidgetArea);
    m_docks.push_back(dock);
    for (const auto changed : {&QDockWidget::visibilityChanged, &QDockWidget::topLevelChanged}) {
      connect(dock, changed, this, &MainWindow::showTitles, Qt::QueuedConnection);
    }
    connect(
        dock, &QDockWidget::dockLocationChanged, this,
        [this] {
          showTitles();
          distributeSpaceLater();
        },
        Qt::QueuedConnection);
    // A panel that is closed does not keep the keys.
    connect(dock, &QDockWidget::visibilityChanged, m_field, [this, dock](bool visible) {
      const QWidget* focus = focusWidget();
      if (!visible && dock->isHidden() && focus != nullptr && dock->isAncestorOf(focus)) {
        m_field->setFocus();
      }
    });
  }
}

void MainWindow::connectField() {
  connect(m_field, &FieldView::selectionChanged, m_selection, &RobotSelection::set);
  connect(m_selection, &RobotSelection::changed, m_field, &FieldView::select);
  connect(m_field, &FieldView::followedChanged, m_selection, &RobotSelection::follow);
  connect(m_selection, &RobotSelection::followedChanged, m_field, &FieldView::follow);
  connect(m_selection, &RobotSelection::chosen, m_field, qOverload<>(&QWidget::setFocus));
  connect(m_selection, &RobotSelection::poseRequested, m_field, &FieldView::editPose);
  connect(m_field, &FieldView::blackboardRequested, m_selection,
          &RobotSelection::blackboardRequested);
  connect(m_overlay, &LiveOverlay::otherReceived, m_field, &FieldView::showOther);
  connect(m_compared, &ComparedSessions::momentReached, m_field, &FieldView::showCompared);
  connect(m_compared, &ComparedSessions::changed, m_field, [this] {
    if (!m_compared->isEmpty()) m_field->showCompared(0, nullptr);
  });
  connect(m_explorer, &Explorer::heatChanged, m_field, &FieldView::showHeat);
  connect(m_future, &AbandonedFuture::momentReached, m_field, [this](const FramePtr& frame) {
    if (m_compared->isEmpty()) m_field->showCompared(0, frame);
  });
  connect(m_field, &FieldView::cursorMoved, m_status, &StudioStatusBar::setCursor);
  connect(m_field, &FieldView::saveScenarioRequested, m_files, &ScenarioFiles::askAndSave);
  connect(m_field, &FieldView::loadMatchRequested, m_files,
          [this] { m_files->load(QStringLiteral("match-3v3")); });
  connect(m_field, &FieldView::resetRequested, m_controller, [this] {
    link::Scenario again = m_controller->beginning();
    again.score = {};
    again.clock = 0.0;
    if (!m_controller->edits()->allowsChange()) return;
    m_controller->edits()->replaceMatch(again, QStringLiteral("Start the match again"),
                                        QStringLiteral("Match restarted"),
                                        m_controller->isPaused());
  });
  connect(m_field, &FieldView::clearRequested, m_controller, [this] {
    std::vector<RobotId> all;
    if (const FramePtr frame = m_controller->frame()) {
      for (const auto& robot : frame->robots) all.push_back(robot.identity.id);
    }
    m_controller->edits()->removeRobots(all);
  });
}

void MainWindow::askToClose(const QStringList& running) {
  const QString name = QStringLiteral("askToClose");
  for (const auto* asked : findChildren<QMessageBox*>(name)) {
    if (asked->isVisible()) return;
  }
  auto* ask = new QMessageBox(QMessageBox::Question, QStringLiteral("Quit Pitchboard"),
                              running.join(QStringLiteral("\n\n")), QMessageBox::NoButton, this);
  ask->setObjectName(name);
  ask->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* quit = ask->addButton(QStringLiteral("Quit"), QMessageBox::DestructiveRole);
  quit->setObjectName(QStringLiteral("quitNow"));
  QPushButton* stay = ask->addButton(QStringLiteral("Don't quit"), QMessageBox::RejectRole);
  stay->setObjectName(QStringLiteral("stay"));
  ask->setDefaultButton(stay);
  ask->setEscapeButton(stay);
  connect(quit, &QPushButton::clicked, this, &MainWindow::closeNow, Qt::QueuedConnection);
  ask->open();
}

void MainWindow::closeNow() {
  m_closesNow = true;
  close();
}

void MainWindow::offerLostRecordings() {
  const QStringList lost = m_recording->drainLost();
  if (lost.isEmpty()) return;
  const QString file = lost.front();
  m_notices->show(
      {QStringLiteral("lost recording")},
      QStringLiteral("Pitchboard ended while it was recording into %1. The part that was written "
                     "can be opened.")
          .arg(lost.join(QStringLiteral(" and "))),
      {{QStringLiteral("Open in Replay"), [this, file] { m_sessions->open(file); }},
       {QStringLiteral("Repair into a new file"), [this, file] { m_sessions->repair(file); }},
       {QStringLiteral("Not now"), {}}});
}

void MainWindow::offerToRemoveOrphans() {
  showOrphanNotice(m_notices, m_controller);
}

// Each thing that can go wrong is a topic: what is right again takes its notice away.
void MainWindow::connectNotices() {
  static const QString match = QStringLiteral("match"), scenario = QStringLiteral("scenario"),
                       live = QStringLiteral("live"), recording = QStringLiteral("recording"),
                       refused = QStringLiteral("refused"), locked = QStringLiteral("locked"),
                       finished = QStringLiteral("finished"), compared = QStringLiteral("compared"),
                       test = QStringLiteral("test"), continued = QStringLiteral("continued"),
                       replaced = QStringLiteral("replaced"), branch = QStringLiteral("branch"),
                       share = QStringLiteral("share");
  const auto noticeOf = [this](const QString& topic) {
    return [this, topic](const QString& sentence) { m_notices->show({topic}, sentence); };
  };
  for (const auto message : {&SessionRecording::failed, &SessionRecording::noted}) {
    connect(m_recording, message, m_notices, noticeOf(recording));
  }
  connect(m_recording, &SessionRecording::failed, this, &MainWindow::recordingFailed);
  connect(m_share, &NetworkShare::failed, m_notices, noticeOf(share));
  connect(m_noteBoard, &NoteBoard::notKept, m_notices, noticeOf(QStringLiteral("notes")));
  connect(m_share, &NetworkShare::changed, m_notices, [this] {
    if (m_share->isOn()) m_notices->settle(share);
  });
  connect(m_recording, &SessionRecording::began, m_notices,
          [this] { m_notices->settle(recording); });
  connect(m_recording, &SessionRecording::saved, this, [this](const QString& path) {
    m_notices->show({recording, NoticeTone::Success}, QStringLiteral("Saved: %1").arg(path),
                    {{QStringLiteral("Open in Replay"), [this, path] { m_sessions->open(path); }},
                     {QStringLiteral("Close"), {}}});
  });
  connect(m_controller, &MatchController::errorOccurred, m_notices,
          [this](const QString& sentence, Trouble trouble) {
            m_notices->show({m_controller->edits()->isLocked() ? locked
                             : trouble == Trouble::Refused     ? refused
                                                               : match},
                            sentence);
          });
  connect(m_controller, &MatchController::askedForSpeed, m_notices,
          [this](const QStringList& programs, double wanted) { askForSpeed(programs, wanted); });
  connect(m_controller, &MatchController::obeyed, m_notices,
          [this] { m_notices->settle(refused); });
  connect(m_controller, &MatchController::rewound, m_notices,
          [this] { m_notices->settle(refused); });
  connect(m_controller, &MatchController::opened, m_notices, [this] {
    if (m_controller->isOpen()) {
      m_notices->settle(scenario);
      return;
    }
    m_notices->show(
        {scenario},
        QStringLiteral("The match could not be opened: %1").arg(m_controller->whyNotOpened()),
        {{QStringLiteral("Try again"),
          [this] { m_controller->open(m_controller->scenario(), m_controller->isPaused()); }},
         {QStringLiteral("Choose a scenario"), [this] { m_bar->scenarios()->showPopup(); }}});
  });
  // A file that could not be opened is old news, unless there is no match.
  connect(m_shown, &ShownMoment::sourceChosen, m_notices, [this] {
    if (m_controller->isOpen()) m_notices->settle(scenario);
  });
  connect(m_controller, &MatchController::scenarioChanged, m_notices, [this] {
    for (const QString& topic : {match, refused, finished, continued, speedTopic}) {
      m_notices->settle(topic);
    }
    m_notifiedFinished = false;
  });
  // What cannot stand still or go faster goes on with a match in real time.
  connect(m_controller, &MatchController::transportChanged, m_notices, [this] {
    if (!m_controller->isPaused() && m_controller->speed() == 1.0) m_notices->settle(match);
  });
  connect(m_controller->edits(), &MatchEdits::replaced, m_notices, [this](const QString& done) {
    QUndoStack* stack = m_controller->edits()->undoStack();
    m_notices->show(
        {replaced, NoticeTone::Success},
        QStringLiteral("%1. Ctrl+Z brings the match back.").arg(done),
        {{QStringLiteral("Undo"), [stack] { stack->undo(); }}, {QStringLiteral("Close"), {}}});
  });
  connect(m_controller->edits()->undoStack(), &QUndoStack::indexChanged, m_notices,
          [this] { m_notices->settle(replaced); });
  connect(m_controller->edits(), &MatchEdits::lockedChanged, m_notices,
          [this] { m_notices->settle(locked); });
  connect(m_controller->memory(), &MatchMemory::continuedWithout, m_notices,
          [this](const QString& sentence, double time) {
            m_notices->show({continued}, sentence);
            m_continuedAt = time;
          });
  connect(m_controller, &MatchController::frameReceived, m_notices, [this](const FramePtr& frame) {
    constexpr double known = 10.0;  // s of the match, after which processes have learned anew
    if (!m_continuedAt || frame->snapshot.time - *m_continuedAt <= known) return;
    m_continuedAt.reset();
    m_notices->settle(continued);
  });
  connect(m_future, &AbandonedFuture::began, m_notices, [this] {
    m_notices->show({branch, NoticeTone::Success},
                    QStringLiteral("Continuing the match from %1. The timeline keeps the abandoned "
                                   "future as a dashed branch.")
                        .arg(clockText(m_future->begin())),
                    {{QStringLiteral("Compare"), [this] { m_future->setCompared(true); }},
                     {QStringLiteral("Drop"), [this] { m_future->drop(); }},
                     {QStringLiteral("Close"), {}}});
  });
  connect(m_future, &AbandonedFuture::changed, m_notices, [this] {
    if (!m_future->isOn()) m_notices->settle(branch);
  });
  connect(m_live, &LiveController::errorOccurred, m_notices, noticeOf(live));
  connect(m_live, &LiveController::optionsChanged, m_notices, [this] { m_notices->settle(live); });
  connect(m_live, &LiveController::eventsReceived, m_notices,
          [this](const std::vector<link::MatchEvent>& events) {
            const link::LiveDetails details = m_live->details();
            const bool portsChanged = std::ranges::any_of(events, [](const auto& event) {
              return event.kind == link::MatchEventKind::PortBack ||
                     event.kind == link::MatchEventKind::PortsShared;
            });
            if (portsChanged && details.sharedPorts.empty() &&
                std::ranges::all_of(details.network.ports, &telemetry::PortStatus::bound)) {
              m_notices->settle(live);
            }
          });
  connect(m_compared, &ComparedSessions::failed, m_notices, noticeOf(compared));
  connect(m_compared, &ComparedSessions::started, m_notices,
          [this] { m_notices->settle(compared); });
  connect(m_tests, &SituationTests::failed, m_notices, noticeOf(test));
  connect(m_tests, &SituationTests::saved, m_notices, [this] { m_notices->settle(test); });
  connect(m_files, &ScenarioFiles::failed, m_notices, noticeOf(scenario));
  connect(m_controller, &MatchController::frameReceived, this,
          [this](const FramePtr& frame) { notifyFinished(*frame); });
}

void MainWindow::askForSpeed(const QStringList& programs, double wanted) {
  using Programs = MatchController::RealTimePrograms;
  const QString speed = wanted == link::MatchRunner::unlimitedSpeed
                            ? QStringLiteral("maximum speed")
                            : QStringLiteral("×%1").arg(numberText(wanted, wanted < 1.0 ? 2 : 0));
  const auto answer = [this, wanted](Programs what) {
    return [this, wanted, what] { m_controller->answerSpeed(wanted, what); };
  };
  m_notices->show(
      {speedTopic},
      QStringLiteral("%1 uses real time (\"clock\": \"real\") and cannot follow %2.")
          .arg(programs.join(QStringLiteral(", ")), speed),
      {{QStringLiteral("Restart with match time"), answer(Programs::RestartWithMatchTime)},
       {QStringLiteral("Stay at ×1"), [this] { m_controller->setSpeed(1.0); }},
       {QStringLiteral("Change speed only for the others"), answer(Programs::LeaveBehind)}});
}

// A match that stands still should not look as if it hung.
void MainWindow::notifyFinished(const link::MatchFrame& frame) {
  if (!frame.finished) {
    if (std::exchange(m_notifiedFinished, false)) m_notices->settle(QStringLiteral("finished"));
    return;
  }
  if (std::exchange(m_notifiedFinished, true)) return;
  m_notices->show(
      {QStringLiteral("finished"), NoticeTone::Success},
      QStringLiteral("The match is over, %1 : %2. Look back on the timeline, export it, or play it "
                     "again.")
          .arg(frame.snapshot.score.left)
          .arg(frame.snapshot.score.right),
      {{QStringLiteral("Play again"),
        [this] {
          m_controller->restart();
          m_controller->setPaused(false);
        }},
       {QStringLiteral("Export…"), [this] { showExport(); }},
       {QStringLiteral("Close"), {}}});
}

}  // namespace pitchboard::ui
