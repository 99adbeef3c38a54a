// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs the recording that Replay shows through a process again, on a thread of its own, and shows
// the result in Replay: the recording with the robot "B1 rerun" beside the original, at the moment
// that was shown. The file with both lives as long as the studio. Programs end with the rerun. UI
// thread only; owned by the window.

#include <QObject>
#include <QTemporaryDir>
#include <QTimer>
#include <atomic>
#include <memory>
#include <optional>

#include <robotlink/rerun/program_watch.h>
#include <robotlink/rerun/rerun.h>
#include <telemetry/series/series_types.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

namespace pitchboard::ui {

class LinkedTime;
class PlotTarget;
class ReplayController;
class ShownMoment;

/// What is to run.
struct RerunOrder {
  link::RerunOptions options;  ///< without functions
  /// Run first, unchanged: what differs then is kept beside the recording and left out. Empty: not.
  std::vector<link::RerunProcess> unchanged;
};

class Rerunner : public QObject {
  Q_OBJECT
 public:
  /// All must outlive it.
  struct Parts {
    ShownMoment* shown = nullptr;
    ReplayController* replay = nullptr;
    LinkedTime* time = nullptr;
    PlotTarget* plots = nullptr;
  };
  Rerunner(const Parts& parts, QObject* parent);
  /// Cancels, and waits until the programs have ended.
  ~Rerunner() override;

  /// Returns why nothing can run again now, as a sentence; empty if it can.
  QString whyNot() const;
  /// Returns the robots of the recording whose processes can run again, by name, and their
  /// processes.
  std::vector<std::pair<QString, QStringList>> robots() const;
  /// Returns the path of the recording that runs again.
  QString recording() const;

  /// Starts; a rerun in progress is cancelled.
  void start(const RerunOrder& order);
  /// Runs the last order again and compares the result with the last one, too.
  void again();
  bool canRunAgain() const { return m_order.has_value() && whyNot().isEmpty(); }
  /// Stops the rerun. An earlier result is kept.
  void cancel();
  bool isRunning() const { return m_running != nullptr; }
  /// Returns the progress of the running rerun, 0 to 1.
  double progress() const { return m_progress; }
  /// Returns whether the unchanged program is running.
  bool isChecking() const { return m_checking; }
  /// Returns why the last rerun has no result, or what has to be said of it; empty: nothing.
  const QString& problem() const { return m_problem; }
  /// Returns the last result for this recording; null if there is none.
  const std::shared_ptr<const link::RerunResult>& result() const { return m_result; }
  const std::optional<RerunOrder>& order() const { return m_order; }

  /// Whether to run again when the program's file changes, while Replay is shown.
  void setFollowing(bool on);
  bool isFollowing() const { return m_watch.has_value(); }
  /// Returns why the program cannot be followed; empty if it can.
  QString whyNotFollow() const;
  /// Writes the result as an HTML page.
  Result<void> writeReport(const QString& path) const;
  /// The program that keeps separate programs; without it, the one beside this program.
  void setRobotProgram(const std::string& path) { m_robotProgram = path; }

  /// Shows both robots' curves of this variable.
  void plot(const QString& variable);

 signals:
  void changed();   ///< progress, result, problem or what can run
  void finished();  ///< a result has come

 private:
  struct Made {
    std::shared_ptr<const link::RerunResult> result;
    QString path, problem;
    std::vector<link::ComparedVariable> unchanged;  // what was found now
  };
  void run(bool again);
  Made make(const std::string& session, RerunOrder order, const std::string& to,
            const std::shared_ptr<std::atomic<bool>>& cancelled);
  void take(const Made& made);
  void showPending();
  void showResult();
  void plotOver();
  void forget();
  void look();

  Parts m_parts;
  std::optional<RerunOrder> m_order;
  QString m_orderOf;  // the recording of m_order and m_result
  std::shared_ptr<const link::RerunResult> m_result;
  QString m_problem;
  double m_progress = 0.0;
  bool m_checking = false;
  QString m_pending;  // a file that Replay is to show
  QString m_showing;  // a file that it was asked to show
  QString m_file;     // the file that it showed last
  struct Place {      // what was shown before
    double time = 0.0;
    std::optional<telemetry::TimeRange> selection, range;
  } m_place;
  std::optional<link::ProgramWatch> m_watch;
  QTimer m_look;
  std::string m_robotProgram;
  std::unique_ptr<QTemporaryDir> m_folder;
  int m_count = 0;
  std::shared_ptr<std::atomic<bool>> m_running;  // set to cancel it; null: none runs
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui
