// SPDX-License-Identifier: GPL-3.0-or-later
#include "menus.h"

#include <QActionGroup>
#include <QApplication>
#include <QDesktopServices>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QMenuBar>
#include <QSettings>
#include <QUrl>

#include <base/documents.h>
#include <ui/base/action_reason.h>
#include <ui/base/notice_bar.h>
#include <ui/base/undo_history.h>
#include <ui/calibrate/calibrate_dialog.h>
#include <ui/experiments/situation_tests.h>
#include <ui/explore/explorer.h>
#include <ui/field/field_view.h>
#include <ui/live/attach_dialog.h>
#include <ui/live/foxglove_dialog.h>
#include <ui/live/live_settings_dialog.h>
#include <ui/plots/plot_menus.h>
#include <ui/plots/plots_dock.h>
#include <ui/rerun/rerun_dialog.h>
#include <ui/robots/robots_dock.h>
#include <ui/rules/rules_dock.h>
#include <ui/session/session_files.h>
#include <ui/share/share_dialog.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/live_overlay.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/note_board.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/timeline/compared_menu.h>
#include <ui/timeline/timeline_actions.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "alarms.h"
#include "field_only.h"
#include "help_windows.h"
#include "mapping_menu.h"
#include "match_menu.h"
#include "scenario_chooser.h"
#include "status_bar.h"
#include "transport_bar.h"

namespace pitchboard::ui {
namespace {

QAction* withIcon(QAction* action, const char* icon, const char* id = nullptr) {
  action->setIcon(themedIcon(QLatin1String(icon)));
  if (id != nullptr) action->setObjectName(QLatin1String(id));
  return action;
}

/// Why a command of the match cannot be given now; empty: it can.
QString whyNotInTheMatch(const ShownMoment& shown, const MatchEdits& edits) {
  if (!shown.kind().canBeEdited) return QStringLiteral("Only in Simulate");
  return edits.isLocked() ? MatchEdits::lockedText() : QString();
}

/// The panel that was asked for has the keys: its first control that takes them.
void focusFirst(QWidget& panel) {
  for (QWidget* next = panel.nextInFocusChain(); next != &panel; next = next->nextInFocusChain()) {
    if (!panel.isAncestorOf(next)) break;
    if ((next->focusPolicy() & Qt::TabFocus) && next->isEnabled() && next->isVisibleTo(&panel)) {
      next->setFocus(Qt::OtherFocusReason);
      return;
    }
  }
}

}  // namespace

StudioMenus::StudioMenus(MenuContext context, MainWindow& window)
    : m_context(std::move(context)), m_parts(m_context.parts), m_window(window) {}

void StudioMenus::make() {
  makeFile();
  makeEdit();
  makeView();
  makeRobots();
  makeSimulation();
  makeLive();
  makeTimeline();
  makePlots();
  makeHelp();
}

void StudioMenus::onlyInTheMatch(QAction* action) {
  const auto show = [action, shown = m_parts.shown, edits = m_parts.controller->edits()] {
    enableUnless(*action, whyNotInTheMatch(*shown, *edits));
  };
  QObject::connect(m_parts.shown, &ShownMoment::sourceChosen, action, show);
  QObject::connect(m_parts.controller->edits(), &MatchEdits::lockedChanged, action, show);
}

void StudioMenus::makeFile() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&File"));
  ScenarioFiles* files = m_context.files;
  withIcon(menu->addAction(QStringLiteral("&Open…"), &m_window,
                           [this_ = &m_window] { this_->askAndOpen(); }),
           "document-open", "openFile");
  QMenu* recent = menu->addMenu(QStringLiteral("Open &recent"));
  QObject::connect(
      menu, &QMenu::aboutToShow, recent,
      [recent, files, window = &m_window, scenarios = m_context.scenarios] {
        recent->clear();
        for (const QString& file : scenarios->recentFiles()) {
          QAction* action = recent->addAction(QFileInfo(file).completeBaseName(), files,
                                              [files, file] { files->open(file); });
          action->setToolTip(file);
        }
        recent->addSeparator();
        for (const QString& file : window->recentSessions()) {
          QAction* action = recent->addAction(QFileInfo(file).fileName(), window,
                                              [window, file] { window->openSession(file); });
          action->setToolTip(file);
        }
        enableUnless(*recent->menuAction(), recent->actions().size() > 1
                                                ? QString()
                                                : QStringLiteral("Nothing has been opened yet"));
      });
  SessionFiles* sessions = m_context.sessions;
  withIcon(menu->addAction(QStringLiteral("Open s&ession…"), sessions, &SessionFiles::askAndOpen),
           "document-open-folder", "openSession");
  QAction* library = menu->addAction(QStringLiteral("&Library"));
  withIcon(library, "folder", "showLibrary");
  library->setToolTip(QStringLiteral("Lists all your sessions: teams, score, notes, a picture"));
  QAction* join = menu->addAction(QStringLiteral("&Add recording of a robot…"), sessions,
                                  &SessionFiles::askAndJoin);
  join->setObjectName(QStringLiteral("addRecording"));
  join->setToolTip(QStringLiteral(
      "Joins what pitchboard-agent recorded on a robot to the live session that is open"));
  QObject::connect(menu, &QMenu::aboutToShow, join, [join, shown = m_parts.shown] {
    enableUnless(*join, shown->kind().hasPresent
                            ? QStringLiteral("Open the live session of the match in Replay first")
                            : QString());
  });
  QObject::connect(menu, &QMenu::aboutToHide, join, [join] { enableUnless(*join, {}); });
  addMappingAction(menu, sessions, &m_window);
  onlyInTheMatch(withIcon(menu->addAction(QStringLiteral("&Save this moment as a scenario…"), files,
                                          &ScenarioFiles::askAndSave),
                          "document-save", "saveScenario"));
  SituationTests* tests = m_parts.tests;
  QAction* asTest = withIcon(
      menu->addAction(QStringLiteral("Save this moment as a &test…"), tests, &SituationTests::ask),
      "document-save-as");
  asTest->setObjectName(QStringLiteral("saveAsTest"));
  QObject::connect(menu, &QMenu::aboutToShow, asTest,
                   [asTest, tests] { enableUnless(*asTest, tests->whyNot()); });
  QObject::connect(menu, &QMenu::aboutToHide, asTest, [asTest] { enableUnless(*asTest, {}); });
  for (QDockWidget* dock : m_context.docks) {
    if (dock->objectName() == QLatin1String("library")) {
      QObject::connect(library, &QAction::triggered, dock, [dock] {
        dock->show();
        dock->raise();
        focusFirst(*dock->widget());
      });
    }
    if (dock->objectName() != QLatin1String("experiments")) continue;
    QObject::connect(tests, &SituationTests::saved, dock, [dock] {
      dock->show();
      dock->raise();
    });
  }
  withIcon(menu->addAction(QStringLiteral("Export &picture…"), files,
                           &ScenarioFiles::askAndExportPicture),
           "document-export");
  QAction* share = menu->addAction(QStringLiteral("S&hare on the network…"), &m_window,
                                   [window = &m_window, parts = m_parts] {
                                     showShareDialog(parts.share, parts.settings, window);
                                   });
  share->setObjectName(QStringLiteral("shareOnNetwork"));
  share->setToolTip(QStringLiteral("Let Foxglove and other programs see what is shown here"));
  menu->addSeparator();
  withIcon(menu->addAction(QStringLiteral("&Quit"), &m_window, &QWidget::close), "application-exit",
           "quit");
}

void StudioMenus::makeEdit() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&Edit"));
  MatchController* controller = m_parts.controller;
  RobotSelection* selection = m_parts.selection;
  ShownMoment* shown = m_parts.shown;
  menu->addAction(withIcon(m_context.undo->undoAction(), "edit-undo", "undo"));
  menu->addAction(withIcon(m_context.undo->redoAction(), "edit-redo", "redo"));
  menu->addSeparator();
  withIcon(menu->addAction(QStringLiteral("Select &all robots"), selection,
                           [shown, selection] {
                             std::vector<RobotUid> all;
                             if (const FramePtr frame = shown->frame()) {
                               for (const auto& robot : frame->robots) {
                                 all.push_back(robot.uid);
                               }
                             }
                             selection->set(all);
                           }),
           "edit-select-all", "selectAll");
  withIcon(menu->addAction(QStringLiteral("&Find anything…"), &m_window,
                           [this_ = &m_window] { this_->showPalette(); }),
           "edit-find", "findAnything");
  QAction* remove = menu->addAction(
      QStringLiteral("&Delete selected robots"), controller, [controller, selection] {
        if (const FramePtr frame = controller->frame()) {
          controller->edits()->removeRobots(frame->slotsOf(selection->ids()));
        }
      });
  withIcon(remove, "edit-delete", "removeSelected");
  const auto allow = [remove, shown, selection, edits = controller->edits()] {
    const QString why = whyNotInTheMatch(*shown, *edits);
    enableUnless(*remove, !why.isEmpty()             ? why
                          : selection->ids().empty() ? QStringLiteral("Select a robot first")
                                                     : QString());
  };
  allow();
  QObject::connect(selection, &RobotSelection::changed, remove, allow);
  QObject::connect(shown, &ShownMoment::sourceChosen, remove, allow);
  QObject::connect(controller->edits(), &MatchEdits::lockedChanged, remove, allow);
}

void StudioMenus::makeThemes(QMenu* menu) {
  auto* group = new QActionGroup(&m_window);
  const std::pair<ThemeChoice, QString> choices[] = {
      {ThemeChoice::FollowDesktop, QStringLiteral("As the &desktop")},
      {ThemeChoice::Light, QStringLiteral("&Light")},
      {ThemeChoice::Dark, QStringLiteral("Da&rk")}};
  for (const auto& [choice, name] : choices) {
    QAction* action = menu->addAction(name);
    action->setCheckable(true);
    action->setChecked(themeChoice() == choice);
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, &m_window,
                     [settings = m_parts.settings, chosen = choice] {
                       setTheme(*qobject_cast<QApplication*>(QApplication::instance()), chosen);
                       settings->setValue(QStringLiteral("window/theme"), static_cast<int>(chosen));
                     });
  }
}

void StudioMenus::makeView() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&View"));
  QMenu* panels = menu->addMenu(QStringLiteral("&Panels"));
  for (QDockWidget* dock : m_context.docks) {
    QAction* action = dock->toggleViewAction();
    panels->addAction(action);
    // Among tabs, what is asked for comes to the front, also what is open behind another; only
    // what is seen is closed. A dock by itself would close what nobody saw.
    action->disconnect(dock);
    QObject::connect(
        action, &QAction::triggered, dock, [window = &m_window, dock, action](bool on) {
          const bool behind =
              !window->tabifiedDockWidgets(dock).isEmpty() && dock->visibleRegion().isEmpty();
          if (on || behind) {
            dock->show();
            dock->raise();
            action->setChecked(true);
            focusFirst(*dock->widget());
          } else {
            dock->close();
          }
        });
  }
  panels->addSeparator();
  panels->addAction(QStringLiteral("&Reset layout"), &m_window, &MainWindow::resetLayout);
  QMenu* layers = menu->addMenu(QStringLiteral("Field &layers"));
  for (QAction* action : m_parts.field->actions().layers) layers->addAction(action);
  layers->addSeparator();
  for (QAction* action : m_parts.field->actions().options) layers->addAction(action);
  const FieldActions& field = m_parts.field->actions();
  QMenu* tools = menu->addMenu(QStringLiteral("Field &tools"));
  for (QAction* action : field.tools) tools->addAction(action);
  menu->addSeparator();
  menu->addActions({field.flip, field.fit, field.publishedKeys});
  menu->addSeparator();
  QAction* overlay = menu->addAction(QStringLiteral("Overlay &live robots"));
  overlay->setObjectName(QStringLiteral("liveOverlay"));
  overlay->setCheckable(true);
  overlay->setToolTip(QStringLiteral("Show simulated and live robots together, matched by number"));
  QObject::connect(overlay, &QAction::toggled, m_parts.overlay, &LiveOverlay::setOn);
  QObject::connect(m_parts.overlay, &LiveOverlay::switched, overlay, &QAction::setChecked);
  QAction* day = menu->addAction(QStringLiteral("Time of &day in Live and Replay"));
  day->setObjectName(QStringLiteral("timesOfDay"));
  day->setCheckable(true);
  day->setChecked(m_parts.shown->timesOfDay());
  day->setToolTip(QStringLiteral(
      "Show 15:03:12 on axes, timeline, log and readouts instead of the time since the start"));
  QObject::connect(day, &QAction::toggled, m_parts.shown, [parts = m_parts](bool on) {
    parts.shown->setTimesOfDay(on);
    if (parts.settings != nullptr) parts.settings->setValue(QStringLiteral("view/timesOfDay"), on);
  });
  menu->addSeparator();
  makeThemes(menu->addMenu(QStringLiteral("&Theme")));
  m_context.alarms->fill(menu->addMenu(QStringLiteral("&Alarms")));
  menu->addAction(m_context.fieldOnly->action());
  QAction* full = menu->addAction(QStringLiteral("&Full screen"));
  full->setCheckable(true);
  withIcon(full, "view-fullscreen", "fullScreen");
  QObject::connect(full, &QAction::triggered, &m_window, [this_ = &m_window](bool on) {
    this_->setWindowState(this_->windowState().setFlag(Qt::WindowFullScreen, on));
  });
}

void StudioMenus::makeRobots() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&Robots"));
  QObject::connect(menu, &QMenu::aboutToShow, &m_window,
                   [menu, field = m_parts.field, match = m_parts.controller, window = &m_window] {
                     qDeleteAll(menu->findChildren<QMenu*>(Qt::FindDirectChildrenOnly));
                     menu->clear();
                     field->fillRobotsMenu(menu);
                     menu->addSeparator();
                     if (auto* cards = window->findChild<RobotsDock*>())
                       cards->addCardActions(*menu);
                     menu->addSeparator();
                     menu->addAction(QStringLiteral("Calibrate &from recording…"), window,
                                     [match, window] { showCalibrateDialog(match, window); });
                   });
}

void StudioMenus::makeLive() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&Live"));
  menu->addAction(QStringLiteral("&Settings and teams…"), &m_window,
                  [window = &m_window, parts = m_parts] {
                    showLiveSettings(parts.live, parts.settings, window);
                  });
  menu->addAction(
      QStringLiteral("&Attach blackboard…"), &m_window,
      [window = &m_window, boards = m_parts.boards] { showAttachDialog(boards, window); });
  menu->addAction(QStringLiteral("Add &Foxglove bridge…"), &m_window,
                  [window = &m_window, parts = m_parts] {
                    mapBridgesOf(showFoxgloveDialog(parts.live, parts.settings, window));
                  });
}

void StudioMenus::makeSimulation() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&Simulation"));
  MatchController* controller = m_parts.controller;
  menu->addActions(m_context.transport);
  QMenu* speeds = menu->addMenu(QStringLiteral("S&peed"));
  onlyInTheMatch(speeds->menuAction());
  QObject::connect(
      speeds, &QMenu::aboutToShow, speeds, [speeds, controller, steps = m_context.speedSteps] {
        speeds->clear();
        for (const double speed : matchSpeeds) {
          QAction* action = speeds->addAction(speedText(speed), controller,
                                              [controller, speed] { controller->setSpeed(speed); });
          action->setCheckable(true);
          action->setChecked(speed == controller->speed());
        }
        speeds->addSeparator();
        speeds->addActions(steps);
      });
  addMatchEntries(menu, controller, &m_window, [this](QAction* action) { onlyInTheMatch(action); });
  menu->addSeparator();
  QAction* freely = menu->addAction(QStringLiteral("Robot processes run &freely at ×1"));
  freely->setCheckable(true);
  freely->setToolTip(
      QStringLiteral("As on the field, with jitter. When off, the match waits for every process in "
                     "each tick, so results repeat"));
  QObject::connect(menu, &QMenu::aboutToShow, freely, [freely, controller] {
    enableUnless(*freely,
                 controller->cognition() == link::Cognition::Separate
                     ? QString()
                     : QStringLiteral("Only if robots run in separate processes (Simulation "
                                      "> Run robot processes)"));
    freely->setChecked(controller->pace() == link::RobotsPace::Free);
  });
  QObject::connect(freely, &QAction::triggered, controller, [controller](bool on) {
    controller->setPace(on ? link::RobotsPace::Free : link::RobotsPace::LockStep);
  });
  QAction* wait = menu->addAction(QStringLiteral("Slow &down for team programs"));
  wait->setCheckable(true);
  QObject::connect(menu, &QMenu::aboutToShow, wait,
                   [wait, controller] { wait->setChecked(controller->waitsForTeamPrograms()); });
  QObject::connect(wait, &QAction::triggered, controller, &MatchController::setWaitForTeamPrograms);
  QAction* clock = menu->addAction(QStringLiteral("Game &clock runs"));
  clock->setCheckable(true);
  onlyInTheMatch(clock);
  QObject::connect(menu, &QMenu::aboutToShow, clock, [clock, shown = m_parts.shown] {
    const FramePtr frame = shown->frame();
    clock->setChecked(frame && frame->snapshot.clockRunning);
  });
  QObject::connect(clock, &QAction::triggered, controller->edits(), &MatchEdits::setClockRunning);
  onlyInTheMatch(menu->addAction(QStringLiteral("Reset &score"), controller->edits(),
                                 &MatchEdits::resetScore));
}

void StudioMenus::makeTimeline() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&Timeline"));
  m_parts.timelineActions->fill(menu);
  addNoteTools(menu, *m_parts.notes);
  menu->addSeparator();
  SessionFiles* sessions = m_context.sessions;
  using Poses = link::MomentOptions::Poses;
  QAction* asBelieved =
      menu->addAction(QStringLiteral("Simulate from here, &as the robots believe"), sessions,
                      [sessions] { sessions->simulateFromHere(Poses::Believed); });
  QAction* asItWas = menu->addAction(QStringLiteral("Simulate from here, as it &was"), sessions,
                                     [sessions] { sessions->simulateFromHere(Poses::True); });
  QAction* follow = menu->addAction(QStringLiteral("S&imulate from here, others follow…"), sessions,
                                    &SessionFiles::askAndFollow);
  follow->setObjectName(QStringLiteral("simulateFollowing"));
  follow->setToolTip(QStringLiteral(
      "Opponents and ball move as they were recorded, until your robots change what happens"));
  QAction* goOn = menu->addAction(QStringLiteral("&Continue the match from this moment"), sessions,
                                  &SessionFiles::continueFromHere);
  asBelieved->setObjectName(QStringLiteral("simulateBelieved"));
  asItWas->setObjectName(QStringLiteral("simulateTrue"));
  goOn->setObjectName(QStringLiteral("continueFromHere"));
  ShownMoment* shown = m_parts.shown;
  const auto refresh = [asItWas, follow, goOn, shown] {
    const FramePtr frame = shown->frame();
    enableUnless(*asItWas,
                 !frame || frame->truthKnown
                     ? QString()
                     : QStringLiteral("The true poses are not known here. Simulate as the "
                                      "robots believe"));
    enableUnless(*follow, shown->kind().hasPresent && !shown->isLookingBack()
                              ? QStringLiteral("Look back on the timeline first: nothing is "
                                               "recorded after this moment")
                              : QString());
    enableUnless(*goOn,
                 !shown->kind().mayBeContinued
                     ? QStringLiteral("Only a match in Simulate can be continued. Here, simulate "
                                      "from this moment")
                 : !shown->isLookingBack() ? QStringLiteral("Look back on the timeline first")
                                           : QString());
  };
  Explorer* explorer = m_parts.explorer;
  QAction* explore =
      menu->addAction(QStringLiteral("E&xplore from this moment"), explorer, &Explorer::start);
  explore->setObjectName(QStringLiteral("exploreMoment"));
  explore->setToolTip(
      QStringLiteral("Shows where the ball may go and how likely a goal is for each team"));
  for (QDockWidget* dock : m_context.docks) {
    if (dock->objectName() != QLatin1String("explore")) continue;
    QObject::connect(explore, &QAction::triggered, dock, [dock] {
      dock->show();
      dock->raise();
    });
  }
  QObject::connect(shown, &ShownMoment::lookingBackChanged, goOn, refresh);
  QObject::connect(shown, &ShownMoment::sourceChanged, goOn, refresh);
  QObject::connect(menu, &QMenu::aboutToShow, goOn, refresh);
  menu->addSeparator();
  Rerunner* rerunner = m_parts.rerunner;
  const RerunDialogParts asked{rerunner, shown, m_parts.selection, m_parts.settings};
  QAction* rerun = menu->addAction(QStringLiteral("Re&run with…"), &m_window,
                                   [this_ = &m_window, asked] { showRerunDialog(asked, this_); });
  rerun->setObjectName(QStringLiteral("rerunWith"));
  rerun->setToolTip(
      QStringLiteral("Runs the recording through a program again and compares what it decides"));
  const auto showRerun = [rerun, rerunner] { enableUnless(*rerun, rerunner->whyNot()); };
  QObject::connect(rerunner, &Rerunner::changed, rerun, showRerun);
  showRerun();
  for (QDockWidget* dock : m_context.docks) {
    if (dock->objectName() != QLatin1String("rerun")) continue;
    QObject::connect(rerunner, &Rerunner::finished, dock, [dock] {
      dock->show();
      dock->raise();
    });
  }
  QAction* rules =
      menu->addAction(QStringLiteral("Check ru&les…"), &m_window,
                      [this_ = &m_window, all = m_parts.rules] { askForRules(all, this_); });
  rules->setObjectName(QStringLiteral("checkRules"));
  rules->setToolTip(
      QStringLiteral("Opens a file with conditions that must not hold, and shows where they do"));
  for (QDockWidget* dock : m_context.docks) {
    if (dock->objectName() != QLatin1String("rules")) continue;
    QObject::connect(rules, &QAction::triggered, dock, [dock] {
      dock->show();
      dock->raise();
    });
  }
  ComparedSessions* compared = m_parts.compared;
  QAction* compare =
      menu->addAction(QStringLiteral("Co&mpare with sessions…"), sessions, [sessions, compared] {
        compared->open(sessions->askForFiles(QStringLiteral("Compare with sessions")));
      });
  QMenu* each = menu->addMenu(QStringLiteral("Compare&d sessions"));
  each->setObjectName(QStringLiteral("comparedSessions"));
  QObject::connect(each, &QMenu::aboutToShow, compared, [each, compared] {
    each->clear();
    for (ComparedSession* session : compared->all()) {
      QMenu* one = each->addMenu(sessionMark(session->number()) + QLatin1Char(' ') +
                                 session->caption().replace(QLatin1Char('&'), QLatin1String("&&")));
      one->setToolTipsVisible(true);
      fillComparedMenu(one, compared, session);
    }
  });
  QAction* byTime = menu->addAction(QStringLiteral("Align compared sessions by &time"), compared,
                                    &ComparedSessions::alignAllByTime);
  QAction* stop =
      menu->addAction(QStringLiteral("Stop c&omparing"), compared, &ComparedSessions::removeAll);
  withIcon(compare, "view-split-left-right", "compareSession");
  stop->setObjectName(QStringLiteral("stopComparing"));
  const auto showCompared = [each, byTime, stop, compared] {
    const QString none =
        compared->isEmpty() ? QStringLiteral("No session is being compared") : QString();
    enableUnless(*each->menuAction(), none);
    enableUnless(*stop, none);
    enableUnless(*byTime, none.isEmpty() && compared->areAlignedByTime()
                              ? QStringLiteral("The sessions are aligned by time")
                              : none);
  };
  QObject::connect(compared, &ComparedSessions::changed, stop, showCompared);
  showCompared();
  menu->addSeparator();
  SessionRecording* recording = m_parts.recording;
  QAction* exportAction = menu->addAction(QStringLiteral("&Export…"), &m_window,
                                          [this_ = &m_window] { this_->showExport(); });
  withIcon(exportAction, "document-export", "exportSession");
  menu->addAction(QStringLiteral("Memor&y for the past…"), &m_window, [this_ = &m_window] {
    bool chosen = false;
    const int megabytes = QInputDialog::getInt(this_, QStringLiteral("Memory for the past"),
                                               QStringLiteral("Memory limit per source (MB):"),
                                               this_->memoryBudget(), 16, 65536, 64, &chosen);
    if (chosen) this_->setMemoryBudget(megabytes);
  });
  menu->addAction(QStringLiteral("&Folder for recordings…"), recording,
                  [this_ = &m_window, recording] {
                    const QString chosen = QFileDialog::getExistingDirectory(
                        this_, QStringLiteral("Folder for recordings"), recording->folder());
                    if (!chosen.isEmpty()) recording->setFolder(chosen);
                  });
}

void StudioMenus::makePlots() {
  if (auto* plots = m_window.findChild<PlotsDock*>()) {
    m_window.menuBar()->addMenu(makePlotsMenu(plots));
  }
}

void StudioMenus::makeHelp() {
  QMenu* menu = m_window.menuBar()->addMenu(QStringLiteral("&Help"));
  const QString page = QString::fromStdString(documentationPath());
  QAction* documentation =
      withIcon(menu->addAction(QStringLiteral("&Documentation"), &m_window,
                               [page] { QDesktopServices::openUrl(QUrl::fromLocalFile(page)); }),
               "help-contents", "documentation");
  documentation->setToolTip(QStringLiteral("Opens %1").arg(page));
  enableUnless(*documentation,
               page.isEmpty() ? QStringLiteral("The documentation is not installed") : QString());
  menu->addSeparator();
  menu->addAction(m_parts.field->actions().showKeys);
  menu->addAction(QStringLiteral("&Keyboard shortcuts"), &m_window, m_context.showShortcuts);
  menu->addAction(QStringLiteral("Copy state &hash"), m_context.status,
                  &StudioStatusBar::copyStateHash);
  menu->addSeparator();
  menu->addAction(QStringLiteral("&About Pitchboard"), &m_window,
                  [this_ = &m_window] { showAbout(this_); });
}

}  // namespace pitchboard::ui
