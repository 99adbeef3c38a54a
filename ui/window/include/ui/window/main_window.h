// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The main window: arranges tool bar, field, docks and menus, and keeps their layout. It contains
// no other logic: matches belong to MatchController, files to ScenarioFiles and SessionFiles.
// shutDown() ends everything in the right order. UI thread only.

#include <QAction>
#include <QMainWindow>
#include <memory>
#include <vector>

#include <ui/base/running_work.h>
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
class ComparedSessions;
class Explorer;
class FieldOnly;
class FieldView;
class KeyMap;
class LinkedTime;
class LiveController;
class LiveOverlay;
class MatchController;
class NetworkShare;
class NoteBoard;
class RuleWatch;
class NoticeBar;
class PlotTarget;
class PlotsDock;
class ReplayController;
class Rerunner;
class RobotSelection;
class ScenarioFiles;
class SessionFiles;
class SessionRecording;
class SituationTests;
class ShownMoment;
class StudioStatusBar;
struct StudioParts;
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
  ShownMoment* shown() const { return m_shown; }
  NoticeBar* notices() const { return m_notices; }
  ScenarioFiles* files() const { return m_files; }
  SessionFiles* sessions() const { return m_sessions; }
  ComparedSessions* compared() const { return m_compared; }
  AbandonedFuture* future() const { return m_future; }
  SessionRecording* recording() const { return m_recording; }
  ReplayController* replay() const { return m_replay; }
  LiveController* live() const { return m_live; }
  AttachedBoards* boards() const { return m_boards; }
  /// Opens a recorded session in Replay. Problems are shown as notices.
  void openSession(const QString& path);
  /// Asks for a scenario or a session.
  void askAndOpen();
  /// Returns the paths of recent sessions that still exist, newest first.
  QStringList recentSessions() const;
  /// Opens the command palette, which finds actions, variables, robots and events.
  void showPalette();
  /// Records the source that is shown into this file. Errors, now or later, are shown as notices
  /// and emit `recordingFailed`.
  void recordInto(const QString& path);
  /// Opens the export dialog for the session, or for what is in memory.
  void showExport();
  // Memory limit for the rows of each source, 1 to 65536 MB; kept in the settings.
  int memoryBudget() const;
  void setMemoryBudget(int megabytes);
  /// Shows the source of this kind; Live starts to listen.
  void showSource(const SourceKind& kind);
  /// Shows simulated and live robots together on the field.
  void overlayLive(bool on);

  /// Restores the layout of the docks, or the default layout if that is not possible.
  void restoreLayout();
  void restorePlace();
  void resetLayout();
  /// Offers to remove blackboards that an earlier run left behind.
  void offerToRemoveOrphans();
  /// Offers recordings that an earlier run did not end, because it was killed.
  void offerLostRecordings();
  /// Closes the window without a question, whatever runs.
  void closeNow();

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
  StudioParts parts();
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
  /// Resizes the panels in proportion to the window.
  void distributeSpace();
  void distributeSpaceLater();
  void notifyFinished(const link::MatchFrame& frame);
  void askToClose(const QStringList& running);
  void askForSpeed(const QStringList& programs, double wanted);

  MatchController* m_controller;
  LiveController* m_live;
  QSettings* m_settings;
  ShownMoment* m_shown;
  UndoHistory* m_undo;
  RobotSelection* m_selection;
  LinkedTime* m_time;
  PlotTarget* m_plots;
  AbandonedFuture* m_future;
  ReplayController* m_replay;
  SessionRecording* m_recording;
  SessionFiles* m_sessions;
  TimelineActions* m_timelineActions;
  AttachedBoards* m_boards;
  FieldView* m_field;
  LiveOverlay* m_overlay;
  ComparedSessions* m_compared;
  NoticeBar* m_notices;
  TransportBar* m_bar;
  StudioStatusBar* m_status;
  ScenarioFiles* m_files;
  SituationTests* m_tests;
  Explorer* m_explorer;
  Rerunner* m_rerunner;
  NetworkShare* m_share;
  NoteBoard* m_noteBoard;
  RuleWatch* m_rules;
  PlotsDock* m_plotsDock = nullptr;
  FieldOnly* m_fieldOnly;
  Alarms* m_alarms;
  std::unique_ptr<KeyMap> m_keys;
  QByteArray m_savedLayout;
  QSize m_firstSize;  // if there is no saved layout
  RunningWork m_work;
  bool m_closesNow = false;
  bool m_wasShown = false;
  bool m_wasActive = false;
  bool m_notifiedFinished = false;
  std::optional<double> m_continuedAt;  // s; processes restarted with what they believed then
  bool m_followsSize = true;            // the user has not resized the panels
  int m_neededHeight = 0;               // of the open panels below the field, px of the mock
  std::vector<QDockWidget*> m_docks;    // order of studioDocks()
};

}  // namespace pitchboard::ui
