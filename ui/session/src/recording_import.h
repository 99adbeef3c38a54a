// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Imports a recording of another program, or joins that of a robot to a session, in the background,
// into a session in a temporary folder that lives as long as this object. A dialog shows the
// progress and can cancel. Owned by SessionFiles; UI thread only.

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QTemporaryDir>
#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include <base/result.h>
#include <robotlink/session/join_recording.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QProgressDialog;
class QWidget;

namespace pitchboard::ui {

class RecordingImport : public QObject {
  Q_OBJECT
 public:
  explicit RecordingImport(QWidget* window);
  ~RecordingImport() override;

  /// Returns whether this is a recording of a kind that only other programs write, by its name.
  /// MCAP files can be ours, too; ReplayController tells them apart.
  static bool isOfOthers(const QString& path);
  /// Imports a file or folder; an import that runs is cancelled.
  void start(const QString& path) { start(QStringList{path}, {}); }
  /// Imports recordings on one clock, with the mapping of a file; empty: the one beside the first
  /// recording, or the usual one.
  void start(const QStringList& recordings, const QString& mappingFile);
  /// Joins what a robot recorded itself to a session, in the same way.
  void join(const QString& session, const QString& recording, const link::JoinOptions& options);

 signals:
  /// The session is made. `notes` say what was not understood.
  void imported(const QString& recording, const QString& session, const QStringList& notes);
  void failed(const QString& sentence);

 private:
  /// Writes the session `to` on the worker's thread and returns sentences about it.
  using Work = std::function<Result<QStringList>(const std::string& to,
                                                 const std::function<bool(double)>& progress)>;
  void run(const QString& path, Work work);
  void showProgress(const QString& path);

  QWidget* m_window;
  std::unique_ptr<QTemporaryDir> m_folder;
  int m_count = 0;
  std::shared_ptr<std::atomic<bool>> m_cancelled;  // of the import that runs; null: none does
  QPointer<QProgressDialog> m_dialog;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui
