// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Session files in the window: opened by menu, by dropping one, or from the command line; what is
// wrong with one is a notice, and a broken one is repaired into a new file from there. UI thread
// only.

#include <QObject>
#include <atomic>

#include <robotlink/session/moment_scenario.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QWidget;

namespace pitchboard::ui {

class MatchController;
class NoticeBar;
class ReplayController;
class SourceSwitch;
class Timeline;

class SessionFiles : public QObject {
  Q_OBJECT
 public:
  SessionFiles(ReplayController* replay, MatchController* controller, SourceSwitch* source,
               Timeline* timeline, NoticeBar* notices, QWidget* window);
  ~SessionFiles() override;

  /// Shows Replay once the file is open.
  void open(const QString& path);
  void askAndOpen();
  /// Empty when no file was chosen.
  QString askForFile(const QString& title);
  /// Into a new file beside it, which is opened.
  void repair(const QString& path);
  /// The moment shown as a scenario that is played from there: the mode becomes Simulate.
  void simulateFromHere(link::MomentOptions::Poses poses);
  /// In Simulate while looking back: the match itself goes on from the moment shown.
  void continueFromHere();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// Windows of several studios are told apart by their sessions.
  void showTitle();
  static QString shortened(const QStringList& sentences);
  void offerRepair(const QString& sentence);

  ReplayController* m_replay;
  MatchController* m_controller;
  SourceSwitch* m_source;
  Timeline* m_timeline;
  NoticeBar* m_notices;
  QWidget* m_window;
  std::atomic<bool> m_cancelled = false;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui
