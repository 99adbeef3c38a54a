// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Record: keeps everything of the simulated match, or of what is heard live, in a session file from
// the press of a button until the next, or until the match ends; and saves what has just happened
// from memory. Files get a name of their own in the chosen folder and are never overwritten. UI
// thread only; the file is written by a thread of its own, and what takes long runs on a worker.

#include <QDir>
#include <QObject>
#include <QPointer>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include <robotlink/session/match_recorder.h>
#include <telemetry/session/recording_health.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

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
  ~SessionRecording() override;  ///< as end(), without a word

  /// Where files go: Documents/Pitchboard unless another one was chosen. Made when needed.
  QString folder() const;
  void setFolder(const QString& folder);

  /// How recordings are written from the next one on; tests give it a disk of their own.
  void setWriting(const telemetry::SessionWriterOptions& options) { m_writing = options; }

  bool isRecording() const { return m_recorder.has_value(); }
  /// What is shown can be recorded.
  bool isPossible() const;
  void start();
  /// As start(), into this file; its folder is made when needed. A file that is there already is
  /// left alone: the new one gets a number behind its name, and `noted` says so.
  void startInto(const QString& path);
  void stop();
  /// stop(), and waits until every file is complete; what there is to say of them has been said
  /// then.
  void end();
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
  void noted(const QString& sentence);  ///< good to know: nothing failed

 private:
  QString newPath(const QString& title);
  QString title() const;
  bool makeFolder(const QDir& folder);
  void begin(const QString& path);
  void checkHealth();
  void warnOf(const telemetry::SessionStatus& status);
  void finish(bool matchEnds);

  /// What records a source of one kind.
  struct Recorder {
    bool live = false;
    std::function<telemetry::SessionStatus()> status;
    std::function<void(const link::MatchEvent&)> append;
    std::function<void()> detach;          ///< nothing reaches it any more
    std::function<Result<void>()> finish;  ///< any thread, once detached
  };
  Result<Recorder> recordMatch(const QString& path);
  Result<Recorder> recordLive(const QString& path);

  // A recording outlives what it records if need be.
  QPointer<MatchController> m_controller;
  QPointer<LiveController> m_live;
  SourceSwitch* m_source;
  Timeline* m_timeline;
  QSettings* m_settings;
  QTimer* m_timer;
  telemetry::SessionWriterOptions m_writing;
  std::optional<Recorder> m_recorder;
  QString m_path;
  std::set<telemetry::RecordingTrouble> m_told;  // of this recording
  std::deque<LogLine> m_log;                     // of the present match, for saveLast()
  UiQueue m_toUi;
  Workers m_worker;
};

/// This path, with a number before its suffix when there is such a file already.
QString freePath(const QString& path);

/// "match-3v3 2026-07-01 14.23.05.mcap" in this folder, with a number behind it when it is there
/// already. `title` may hold anything.
QString sessionFileName(const QDir& folder, const QString& title, const QDateTime& when);

}  // namespace pitchboard::ui
