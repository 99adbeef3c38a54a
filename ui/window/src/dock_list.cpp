// SPDX-License-Identifier: GPL-3.0-or-later
#include "dock_list.h"

#include <QAction>

#include <ui/experiments/experiments_dock.h>
#include <ui/experiments/situation_tests.h>
#include <ui/explore/explore_dock.h>
#include <ui/field/field_view.h>
#include <ui/library/library_dock.h>
#include <ui/live/attach_dialog.h>
#include <ui/live/bad_messages_dock.h>
#include <ui/log/log_dock.h>
#include <ui/noise/noise_dock.h>
#include <ui/notes/notes_dock.h>
#include <ui/plots/plots_dock.h>
#include <ui/processes/processes_dock.h>
#include <ui/referee/referee_panel.h>
#include <ui/rerun/rerun_dialog.h>
#include <ui/rerun/rerun_dock.h>
#include <ui/robots/robots_dock.h>
#include <ui/rules/rules_dock.h>
#include <ui/session/session_files.h>
#include <ui/sources/compared_sessions.h>
#include <ui/statistics/plays_dock.h>
#include <ui/statistics/statistics_dock.h>
#include <ui/timeline/timeline_dock.h>
#include <ui/variables/variables_dock.h>
#include <ui/video/video_dock.h>

#include "studio_parts.h"

namespace pitchboard::ui {

namespace {

/// What a newcomer sees moving: how far one robot sees the ball, and what it decides.
PlotLayout firstPlots() {
  PaneSpec distance, decision;
  distance.curves << variableCurve(QStringLiteral("first/VISION_BALL_DIST"));
  decision.kind = PaneKind::Lane;
  decision.curves << variableCurve(QStringLiteral("first/DECISION_ACTION_A"));
  return {{{QStringLiteral("Plots"), {distance, decision}}}, 0};
}

// Each dock gets what it uses and no more.
QWidget* robots(const StudioParts& s, QWidget* parent) {
  return makeRobotsDock({s.controller, s.shown, s.selection, s.overlay, s.settings, s.live},
                        parent);
}
QWidget* variables(const StudioParts& s, QWidget* parent) {
  return makeVariablesDock(
      {s.controller, s.shown, s.plots, s.settings, s.selection, s.boards,
       [boards = s.boards, parent] { showAttachDialog(boards, parent->window()); }},
      parent);
}
QWidget* noise(const StudioParts& s, QWidget* parent) {
  return makeNoiseDock(s.controller, s.selection, s.shown, parent);
}
QWidget* referee(const StudioParts& s, QWidget* parent) {
  return makeRefereePanel({s.controller, s.shown, s.selection}, parent);
}
QWidget* plots(const StudioParts& s, QWidget* parent) {
  return makePlotsDock(
      {s.shown, s.time, s.plots, s.settings, s.compared, s.future, firstPlots(), s.notes}, parent);
}
QWidget* processes(const StudioParts& s, QWidget* parent) {
  return makeProcessesDock(s.controller, s.shown, parent);
}
QWidget* badMessages(const StudioParts& s, QWidget* parent) {
  return makeBadMessagesDock(s.live, parent);
}
QWidget* experiments(const StudioParts& s, QWidget* parent) {
  return makeExperimentsDock({s.replay, s.compared, s.tests, s.work}, parent);
}
QWidget* explore(const StudioParts& s, QWidget* parent) {
  return makeExploreDock({s.explorer, s.shown}, parent);
}
QWidget* rerun(const StudioParts& s, QWidget* parent) {
  return makeRerunDock({s.rerunner, s.shown,
                        [asked = RerunDialogParts{s.rerunner, s.shown, s.selection, s.settings},
                         parent] { showRerunDialog(asked, parent->window()); }},
                       parent);
}
QWidget* rules(const StudioParts& s, QWidget* parent) {
  return makeRulesDock(s.rules, s.shown, parent);
}
QWidget* notes(const StudioParts& s, QWidget* parent) {
  return makeNotesDock(s.notes, parent);
}
QWidget* statistics(const StudioParts& s, QWidget* parent) {
  return makeStatisticsDock({s.shown, s.replay, s.compared, s.selection, s.settings}, parent);
}
QWidget* video(const StudioParts& s, QWidget* parent) {
  return makeVideoDock({s.shown, s.replay, s.recording, s.notes}, parent);
}

QWidget* plays(const StudioParts& s, QWidget* parent) {
  const RerunDialogParts asked{s.rerunner, s.shown, s.selection, s.settings};
  return makePlaysDock(
      {s.shown, s.replay, s.compared, [tests = s.tests] { tests->ask(); },
       [asked, parent] { showRerunDialog(asked, parent->window()); },
       [parent] {
         auto* action = parent->window()->findChild<QAction*>(QStringLiteral("exportSession"));
         if (action != nullptr) action->trigger();
       }},
      parent);
}
QWidget* library(const StudioParts& s, QWidget* parent) {
  return makeLibraryDock({s.settings, s.recording, s.field,
                          [sessions = s.sessions](const QString& path) { sessions->open(path); },
                          [compared = s.compared](const QString& path) { compared->open({path}); }},
                         parent);
}
QWidget* log(const StudioParts& s, QWidget* parent) {
  return makeLogDock(s.controller, s.shown, parent);
}
QWidget* timeline(const StudioParts& s, QWidget* parent) {
  return makeTimelineDock({s.time, s.shown, s.timelineActions, s.compared, s.future, s.rules},
                          parent);
}

}  // namespace

std::span<const DockInfo> studioDocks() {
  static constexpr DockInfo docks[] = {
      {"robots", "Robots", Qt::LeftDockWidgetArea, true, robots},
      {"variables", "Variables", Qt::RightDockWidgetArea, true, variables},
      {"noise", "Noise and physics", Qt::RightDockWidgetArea, false, noise},
      {"plots", "Plots", Qt::BottomDockWidgetArea, true, plots},
      {"processes", "Processes", Qt::BottomDockWidgetArea, true, processes},
      {"referee", "Referee", Qt::RightDockWidgetArea, false, referee},
      {"explore", "Explore", Qt::RightDockWidgetArea, false, explore},
      {"badMessages", "Bad messages", Qt::BottomDockWidgetArea, false, badMessages},
      {"log", "Log", Qt::BottomDockWidgetArea, true, log},
      {"experiments", "Experiments", Qt::BottomDockWidgetArea, false, experiments, false, 300},
      {"rerun", "Rerun", Qt::BottomDockWidgetArea, false, rerun, false, 300},
      {"rules", "Rules", Qt::BottomDockWidgetArea, false, rules, false, 220},
      {"notes", "Notes", Qt::BottomDockWidgetArea, false, notes, false, 220},
      {"statistics", "Statistics", Qt::BottomDockWidgetArea, false, statistics, false, 300},
      {"plays", "Play by play", Qt::BottomDockWidgetArea, false, plays, false, 300},
      {"video", "Video", Qt::BottomDockWidgetArea, false, video, false, 300},
      {"library", "Library", Qt::BottomDockWidgetArea, false, library, false, 300},
      {"timeline", "Timeline", Qt::BottomDockWidgetArea, true, timeline, true},
  };
  return docks;
}

}  // namespace pitchboard::ui
