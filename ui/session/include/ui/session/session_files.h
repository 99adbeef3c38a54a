// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Opens session files from the menu, by drag and drop, or from the command line, also recordings of
// other programs, which are imported first. Problems are shown as notices, from which a damaged
// file can be repaired into a new one. UI thread only.

#include <QObject>
#include <atomic>

#include <robotlink/session/follow_recording.h>
#include <robotlink/session/moment_scenario.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/frame_source.h>

class QWidget;

namespace pitchboard::ui {

class MatchController;
class NoticeBar;
class RecordingImport;
class ReplayController;
class ShownMoment;

class SessionFiles : public QObject {
  Q_OBJECT
 public:
  SessionFiles(ReplayController* replay, MatchController* controller, ShownMoment* shown,
               NoticeBar* notices, QWidget* window);
  ~SessionFiles() override;

  /// Shows Replay once the file is open.
  void open(const QString& path);
  void askAndOpen();
  /// Asks for a file; returns an empty path if none was chosen.
  QString askForFile(const QString& title);
  QStringList askForFiles(const QString& title);
  /// Asks for what a robot recorded itself and how the clocks compare, joins it to the session that
  /// is open, and opens the result.
  void askAndJoin();
  /// Imports recordings of other programs with the mapping of a file, and opens the result.
  void importWith(const QStringList& recordings, const QString& mappingFile);
  /// Returns the recordings of other programs that are open; empty if the session is one of ours.
  QStringList importedRecordings() const;
  /// The same with this recording.
  void askHowToJoin(const QString& recording);
  /// Repairs the session into a new file beside it, and opens that.
  void repair(const QString& path);
  bool isRepairing() const { return m_repairs > 0; }
  /// Switches to Simulate and plays a match that starts from the moment shown.
  void simulateFromHere(link::MomentOptions::Poses poses);
  /// The same from the true poses, or else the believed ones, after asking who follows what was
  /// recorded after that moment.
  void askAndFollow();
  /// In Simulate while looking back: continues the match from the moment shown.
  void continueFromHere();

 signals:
  /// Somebody wants to say what the topics of these recordings mean.
  void mappingWanted(const QStringList& recordings);
  /// Another file is shown in place of the session that was open.
  void replaced();
  /// Several sessions were dropped: the first one is shown, and these are wanted beside it.
  void besideRequested(const QStringList& paths);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void openAll(const QStringList& paths);
  void openBeside();
  /// The window title names the session, which distinguishes several studios.
  void showTitle();
  Result<std::shared_ptr<const link::FollowedRecording>> recordingAfter(
      const link::MatchFrame& frame, const link::Scenario& scenario,
      link::FollowOptions options) const;
  void simulateFrom(const FramePtr& frame, link::MomentOptions::Poses poses,
                    const link::FollowOptions& follow);
  static QString shortened(const QStringList& sentences);
  void offerRepair(const QString& sentence);
  void showImported(const QString& recording, const QString& session, const QStringList& notes);

  ReplayController* m_replay;
  MatchController* m_controller;
  ShownMoment* m_shown;
  NoticeBar* m_notices;
  QWidget* m_window;
  RecordingImport* m_import;
  QStringList m_importing, m_imported;  // recordings, of m_importedSession
  QString m_importedSession;
  QStringList m_beside;  // to be compared with the file that is being opened
  QString m_before;      // the session that was open when open() was asked for another one
  int m_repairs = 0;     // that run or wait
  std::atomic<bool> m_cancelled = false;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui
