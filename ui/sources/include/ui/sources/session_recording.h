// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records the simulated match or the live data to a session file until it is stopped, and saves the
// recent past from memory. If another match replaces the recorded one, recording goes on with it in
// a new file. Files get new names in the chosen folder and are never overwritten. UI thread only;
// files are written on other threads.

#include <QDir>
#include <QObject>
#include <QPointer>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include <robotlink/session/match_recorder.h>
#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/recording_health.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/frame_source.h>

class QSettings;
class QTimer;

namespace pitchboard::ui {

class LiveController;
class MatchController;
class ShownMoment;

/// Writes a session to this path, which must not exist.
using SessionMaker = std::function<Result<void>(const QString& path)>;

class SessionRecording : public QObject {
  Q_OBJECT
 public:
  SessionRecording(MatchController* controller, LiveController* live, ShownMoment* shown,
                   QSettings* settings, QObject* parent);
  ~SessionRecording() override;  ///< same as end(), without signals

  /// Returns the folder for files: Documents/Pitchboard unless another one was chosen. It is
  /// created when needed.
  QString folder() const;
  void setFolder(const QString& folder);

  /// Sets how later recordings are written; tests simulate disks with it.
  void setWriting(const telemetry::SessionWriterOptions& options) { m_writing = options; }

  bool isRecording() const { return m_recorder.has_value(); }
  /// `notes` returns the drawn notes of a source; what is saved from memory keeps them.
  void setDrawnNotes(std::function<std::vector<telemetry::DrawnNote>(FrameSource*)> notes) {
    m_drawnNotes = std::move(notes);
  }
  /// Returns whether the source that is shown can be recorded.
  bool isPossible() const;
  void start();
  /// Like start(), but into this file, whose folder is created if needed. If the file exists, a
  /// number is added to the name, and `noted` says so.
  void startInto(const QString& path);
  void stop();
  /// Stops and waits until all files are complete and all signals have been emitted.
  void end();
  /// Returns the status of the current recording.
  telemetry::SessionStatus status() const;
  QString path() const { return m_path; }
  /// Returns the source that is being recorded; null if none is.
  const FrameSource* source() const;
  /// Returns the files of recordings that a studio with these settings did not end, because it was
  /// killed, and forgets them. Those of a studio that still runs are not among them.
  QStringList drainLost();

  /// Saves the last `seconds` from memory into a new file; `saved` follows.
  void saveLast(double seconds);
  /// Returns a function that writes the last `seconds` before this call, of the simulated match or
  /// of Live, on any thread. Empty if nothing is in memory, or if a session is shown.
  SessionMaker recentPast(double seconds) const;

 signals:
  void changed();  ///< started or stopped
  void began();    ///< started, with a new file
  /// A file is complete that was recorded of this source.
  void saved(const QString& path, const pitchboard::ui::FrameSource* source);
  void failed(const QString& sentence);
  void noted(const QString& sentence);  ///< a remark; nothing failed

 private:
  QString newPath(const QString& title);
  QString title() const;
  QString matchTitle() const;
  bool makeFolder(const QDir& folder);
  void begin(const QString& path,
             std::vector<std::shared_ptr<link::TickObserver>>* observers = nullptr);
  void goOn(std::vector<std::shared_ptr<link::TickObserver>>& observers);
  /// Keeps in the settings what this studio records, for drainLost() after it was killed.
  void keepPath(const QString& path);
  void checkHealth();
  void warnOf(const telemetry::SessionStatus& status);
  void finish(bool matchEnds);
  const FrameSource* sourceOf(bool live) const;

  /// The recorder of one kind of source.
  struct Recorder {
    bool live = false;
    std::function<telemetry::SessionStatus()> status;
    std::function<void(const link::MatchEvent&)> append;
    std::function<void()> detach;          ///< after this, it receives nothing more
    std::function<Result<void>()> finish;  ///< any thread, once detached
  };
  /// `observers`: of the match that is being opened; null: of the one that is open.
  Result<Recorder> recordMatch(const QString& path,
                               std::vector<std::shared_ptr<link::TickObserver>>* observers);
  Result<Recorder> recordLive(const QString& path);

  // A recording outlives what it records if need be.
  QPointer<MatchController> m_controller;
  QPointer<LiveController> m_live;
  ShownMoment* m_shown;
  QSettings* m_settings;
  QTimer* m_timer;
  telemetry::SessionWriterOptions m_writing;
  std::optional<Recorder> m_recorder;
  QString m_path;
  std::function<std::vector<telemetry::DrawnNote>(FrameSource*)> m_drawnNotes;
  QString m_endedPath;  // of a recording that ended with its match; empty: none did
  std::set<telemetry::RecordingTrouble> m_reported;  // of this recording
  std::deque<LogLine> m_log;                         // of the present match, for saveLast()
  UiQueue m_toUi;
  Workers m_worker;
};

/// Returns the path, with a number before its suffix if the file exists.
QString freePath(const QString& path);

/// Returns a new name in the folder, such as "match-3v3 2026-07-01 14.23.05.mcap". `title` may be
/// any text.
QString sessionFileName(const QDir& folder, const QString& title, const QDateTime& when);

}  // namespace pitchboard::ui
