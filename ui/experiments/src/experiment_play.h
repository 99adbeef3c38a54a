// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An experiment that is played for the studio: in threads of its own, into a folder of the user's
// data, with progress and cancel. What has been played comes to the UI thread as values. UI thread;
// owned by the dock, whose end waits for the runs that are being played to stop.

#include <QObject>
#include <QString>
#include <atomic>
#include <memory>

#include <robotlink/experiment/experiment_folder.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

namespace pitchboard::ui {

/// What can be shown of an experiment; never changed once it is there.
struct PlayedExperiment {
  link::Experiment experiment;
  QString folder;
  link::ResultTable table;
  link::ExperimentSummary summary;
};
using PlayedPtr = std::shared_ptr<const PlayedExperiment>;

class ExperimentPlay : public QObject {
  Q_OBJECT
 public:
  explicit ExperimentPlay(QObject* parent = nullptr);
  ~ExperimentPlay() override;

  bool isPlaying() const { return m_playing; }
  /// Plays it into a new folder below `folders`, one run for each processor at a time.
  void start(link::Experiment experiment, const QString& folders);
  /// Plays the runs that are missing in `folder`, which has results of this experiment.
  void resume(link::Experiment experiment, const QString& folder);
  /// Returns the newest folder below `folders` with results of this experiment, if it lacks some
  /// runs; else an empty text.
  static QString unfinished(const link::Experiment& experiment, const QString& folders);
  /// Keeps what has been played; `ended` follows.
  void cancel();
  /// Plays runs again into session files; `recorded` or `failed` follows.
  void record(PlayedPtr of, std::vector<std::size_t> numbers);

 signals:
  /// `each`: s for each run played so far, of which several are played at once.
  void progressed(qulonglong done, qulonglong all, double each);
  /// All runs are there, or it was cancelled: then the summary is that of the runs that are.
  void ended(const pitchboard::ui::PlayedPtr& played);
  /// In the order in which they were asked for.
  void recorded(const QStringList& sessions);
  void failed(const QString& sentence);

 private:
  void begin(link::Experiment experiment, const QString& folder, bool resume);
  void play(const link::Experiment& experiment, const QString& folder, bool resume);
  Result<QString> recordOne(const PlayedExperiment& of, std::size_t number);
  void fail(const Error& error);

  std::atomic<bool> m_cancelled{false};
  bool m_playing = false;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui
