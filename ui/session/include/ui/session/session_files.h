// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Opens session files from the menu, by drag and drop, or from the command line. Problems are shown
// as notices, from which a damaged file can be repaired into a new one. UI thread only.

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
  /// Asks for a file; returns an empty path if none was chosen.
  QString askForFile(const QString& title);
  /// Repairs the session into a new file beside it, and opens that.
  void repair(const QString& path);
  /// Switches to Simulate and plays a match that starts from the moment shown.
  void simulateFromHere(link::MomentOptions::Poses poses);
  /// In Simulate while looking back: continues the match from the moment shown.
  void continueFromHere();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// The window title names the session, which distinguishes several studios.
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
