// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Record: keeps everything of the simulated match in a session file from the press of a button until
// the next, or until the match ends; and saves what has just happened from memory. Files get a name
// of their own in the chosen folder and are never overwritten. UI thread only; the file is written by
// a thread of its own, and what takes long runs on a worker.

#include <QDir>
#include <QObject>
#include <QThreadPool>
#include <deque>
#include <memory>

#include <robotlink/match_recorder.h>

class QSettings;
class QTimer;

namespace pitchboard::ui {

class MatchController;
class SourceSwitch;
class Timeline;

class SessionRecording : public QObject {
  Q_OBJECT
 public:
  SessionRecording(MatchController* controller, SourceSwitch* source, Timeline* timeline,
                   QSettings* settings, QObject* parent);
  ~SessionRecording() override;   ///< ends a recording that goes on

  /// Where files go: Documents/Pitchboard unless another one was chosen. Made when needed.
  QString folder() const;
  void setFolder(const QString& folder);

  bool isRecording() const { return m_recorder != nullptr; }
  /// What is shown can be recorded.
  bool isPossible() const;
  void start();
  void stop();
  /// Of the recording that goes on.
  telemetry::SessionStatus status() const;
  QString path() const { return m_path; }

  /// What happened in the last `seconds`, from memory into a new file; `saved` follows.
  void saveLast(double seconds);

 signals:
  void changed();                          ///< started or stopped
  void saved(const QString& path);         ///< a file is complete
  void failed(const QString& sentence);

 private:
  QString newPath(const QString& title);
  void checkHealth();
  void finish(bool matchEnds);

  MatchController* m_controller;
  SourceSwitch* m_source;
  Timeline* m_timeline;
  QSettings* m_settings;
  QTimer* m_timer;
  std::shared_ptr<link::MatchRecorder> m_recorder;
  QString m_path;
  std::deque<telemetry::SessionLogLine> m_log;   // of the present match, for saveLast()
  QThreadPool m_worker;
};

/// "match-3v3 2026-07-01 14.23.05.mcap" in this folder, with a number behind it when it is there
/// already. `title` may hold anything.
QString sessionFileName(const QDir& folder, const QString& title, const QDateTime& when);

}  // namespace pitchboard::ui
