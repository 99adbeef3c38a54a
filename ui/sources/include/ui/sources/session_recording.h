// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Record: keeps everything of the simulated match, or of what is heard live, in a session file from
// the press of a button until the next, or until the match ends; and saves what has just happened
// from memory. Files get a name of their own in the chosen folder and are never overwritten. UI
// thread only; the file is written by a thread of its own, and what takes long runs on a worker.

#include <QDir>
#include <QObject>
#include <QThreadPool>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include <robotlink/session/match_recorder.h>

class QSettings;
class QTimer;

namespace pitchboard::ui {

class LiveController;
class MatchController;
class SourceSwitch;
class Timeline;

/// Writes a session to this path, which is not there yet.
using SessionMaker = std::function<Result<void>(const QString& path)>;

class SessionRecording : public QObject {
  Q_OBJECT
 public:
  SessionRecording(MatchController* controller, LiveController* live, SourceSwitch* source,
                   Timeline* timeline, QSettings* settings, QObject* parent);
  ~SessionRecording() override;  ///< ends a recording that goes on

  /// Where files go: Documents/Pitchboard unless another one was chosen. Made when needed.
  QString folder() const;
  void setFolder(const QString& folder);

  bool isRecording() const { return m_recorder.has_value(); }
  /// What is shown can be recorded.
  bool isPossible() const;
  void start();
  void stop();
  /// Of the recording that goes on.
  telemetry::SessionStatus status() const;
  QString path() const { return m_path; }

  /// What happened in the last `seconds`, from memory into a new file; `saved` follows.
  void saveLast(double seconds);
  /// Writes the last `seconds` of the simulated match or of what was heard, on any thread; the past
  /// is what it is now. Empty when nothing is in memory, or a session is shown.
  SessionMaker recentPast(double seconds) const;

 signals:
  void changed();                   ///< started or stopped
  void saved(const QString& path);  ///< a file is complete
  void failed(const QString& sentence);

 private:
  QString newPath(const QString& title);
  void checkHealth();
  void finish(bool matchEnds);
  telemetry::WallTime zeroOfLive() const;

  /// What records a source of one kind.
  struct Recorder {
    bool live = false;
    std::function<telemetry::SessionStatus()> status;
    std::function<void(const telemetry::SessionEvent&)> append;
    std::function<void()> detach;          ///< nothing reaches it any more
    std::function<Result<void>()> finish;  ///< any thread, once detached
  };
  Result<Recorder> recordMatch(const QString& path);
  Result<Recorder> recordLive(const QString& path);

  MatchController* m_controller;
  LiveController* m_live;
  SourceSwitch* m_source;
  Timeline* m_timeline;
  QSettings* m_settings;
  QTimer* m_timer;
  std::optional<Recorder> m_recorder;
  QString m_path;
  std::deque<telemetry::SessionLogLine> m_log;  // of the present match, for saveLast()
  QThreadPool m_worker;
};

/// "match-3v3 2026-07-01 14.23.05.mcap" in this folder, with a number behind it when it is there
/// already. `title` may hold anything.
QString sessionFileName(const QDir& folder, const QString& title, const QDateTime& when);

}  // namespace pitchboard::ui
