// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio's window: arranges tool bar, field, docks and menus, and keeps their layout. It owns
// no logic: the match is the controller's, files are ScenarioFiles', docks look after themselves.
// How the studio ends stands in one place, shutDown(). UI thread only.

#include <QAction>
#include <QMainWindow>
#include <memory>
#include <vector>

#include <ui/base/theme.h>
#include <ui/sources/frame_source.h>

class QSettings;

namespace pitchboard::link {
struct MatchFrame;
struct Scenario;
}  // namespace pitchboard::link

namespace pitchboard::ui {

class AbandonedFuture;
class Alarms;
class AttachedBoards;
class ComparedSession;
class Explorer;
class FieldOnly;
class FieldView;
class KeyMap;
class LinkedTime;
class LiveController;
class LiveOverlay;
class MatchController;
class NoticeBar;
class PlotTarget;
class PlotsDock;
class ReplayController;
class RobotSelection;
class ScenarioFiles;
class SessionFiles;
class SessionRecording;
class SituationTests;
class SourceSwitch;
class StudioStatusBar;
struct StudioParts;
class Timeline;
class TimelineActions;
class TransportBar;
class UndoHistory;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  /// Both must outlive the window. `settings` holds layout, theme and recent files.
  MainWindow(MatchController* controller, QSettings* settings, QWidget* parent = nullptr);
  ~MainWindow() override;

  FieldView* field() const { return m_field; }
  Timeline* timeline() const { return m_timeline; }
  NoticeBar* notices() const { return m_notices; }
  ScenarioFiles* files() const { return m_files; }
  SessionFiles* sessions() const { return m_sessions; }
  ComparedSession* compared() const { return m_compared; }
  AbandonedFuture* future() const { return m_future; }
  SessionRecording* recording() const { return m_recording; }
  ReplayController* replay() const { return m_replay; }
  LiveController* live() const { return m_live; }
  AttachedBoards* boards() const { return m_boards; }
  /// A recorded session, in Replay; what is wrong with it is a notice.
  void openSession(const QString& path);
  /// Asks for a scenario or a session.
  void askAndOpen();
  /// Paths, newest first, of sessions that are still there.
  QStringList recentSessions() const;
  /// Finds actions, variables, robots and events by words.
  void showPalette();
  /// Records what is shown into this file, as the button does into one of its own choice. What goes
  /// wrong, now or later, is a notice and `recordingFailed`.
  void recordInto(const QString& path);
  /// Offers to export from what is shown: the session, or what memory holds.
  void showExport();
  /// Megabytes that the rows of one source may take in memory, 1 to 65536; kept in the settings.
  int memoryBudget() const;
  void setMemoryBudget(int megabytes);
  /// Shows this kind of source; Live begins to listen.
  void showSource(SourceKind kind);
  /// Simulated and heard robots side by side on the field.
  void overlayLive(bool on);

  /// Docks where they were; the default layout when there is none or it cannot be restored.
  void restoreLayout();
  void resetLayout();
  /// Offers to remove blackboards that an earlier run left at this key base.
  void offerToRemoveOrphans();

 signals:
  void recordingFailed(const QString& sentence);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  StudioParts parts() const;
  void makeMenus();
  void makeKeys();
  void cancelStepByStep();
  void makeDocks();
  void showTitles();
  void connectField();
  void shutDown();
  void connectNotices();
  void nameForScreenReaders();
  void saveLayout();
  void fitScreen();
  /// Gives panels the room that is theirs in a window of this size.
  void shareRoomOut();
  void tellFinished(const link::MatchFrame& frame);
  void askForSpeed(const QStringList& programs, double wanted);

  MatchController* m_controller;
  LiveController* m_live;
  QSettings* m_settings;
  SourceSwitch* m_source;
  UndoHistory* m_undo;
  RobotSelection* m_selection;
  LinkedTime* m_time;
  PlotTarget* m_plots;
  Timeline* m_timeline;
  AbandonedFuture* m_future;
  ReplayController* m_replay;
  SessionRecording* m_recording;
  SessionFiles* m_sessions;
  TimelineActions* m_timelineActions;
  AttachedBoards* m_boards;
  FieldView* m_field;
  LiveOverlay* m_overlay;
  ComparedSession* m_compared;
  NoticeBar* m_notices;
  TransportBar* m_bar;
  StudioStatusBar* m_status;
  ScenarioFiles* m_files;
  SituationTests* m_tests;
  Explorer* m_explorer;
  PlotsDock* m_plotsDock = nullptr;
  FieldOnly* m_fieldOnly;
  Alarms* m_alarms;
  std::unique_ptr<KeyMap> m_keys;
  QByteArray m_savedLayout;
  QSize m_firstSize;  // when it was not kept from the last time
  bool m_wasShown = false;
  bool m_wasActive = false;
  bool m_toldFinished = false;
  bool m_followsSize = true;          // nobody has given the panels other sizes
  int m_neededHeight = 0;             // of the open panels below the field, px of the mock
  std::vector<QDockWidget*> m_docks;  // order of studioDocks()
};

}  // namespace pitchboard::ui
