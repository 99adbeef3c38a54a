// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Explores the moment that the studio shows, of a simulated, live or recorded match, on a thread of
// its own: what may follow, and what a chosen robot had best do. It only reads frames; nothing is
// sent to a robot. UI thread only; owned by the window.

#include <QObject>
#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include <robotlink/explore/explore.h>
#include <simcore/world/team_color.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/forecast.h>

namespace pitchboard::ui {

class MatchController;
class ReplayController;
class SourceSwitch;

/// What an exploration has found so far.
struct ExploredMoment {
  double time = 0.0;  ///< s of the source
  link::ExploreStart start;
  link::ExploreResult result;                     ///< empty until the first round is played
  std::optional<RobotKey> robot;                  ///< whose actions were compared
  std::array<std::optional<TeamColor>, 2> teams;  ///< that defend the left and right goal
};

class Explorer : public QObject {
  Q_OBJECT
 public:
  static constexpr int seconds = 30;
  static constexpr int firstSecond = 5;  ///< whose heat map is shown at first

  /// Everything outlives the explorer.
  struct Parts {
    SourceSwitch* source = nullptr;
    const MatchController* match = nullptr;
    const ReplayController* replay = nullptr;
  };
  Explorer(const Parts& parts, QObject* parent);
  /// Cancels, and waits for the thread.
  ~Explorer() override;

  /// Whose actions the next exploration compares; nothing: nobody's.
  void setRobot(std::optional<RobotKey> robot);
  std::optional<RobotKey> robot() const { return m_robot; }

  /// Explores the moment shown, also while looking back. A running exploration is cancelled.
  void start();
  /// Stops; what was found stays.
  void cancel();
  /// Stops, and forgets what was found.
  void clear();
  bool isRunning() const { return m_running != nullptr; }
  /// 0 to 1.
  double progress() const { return m_progress; }
  /// Null before the first exploration and after clear().
  const ExploredMoment* found() const { return m_found.get(); }
  /// Why the last exploration found nothing; empty if it did.
  const QString& problem() const { return m_problem; }

  /// Which time after the moment the field shows, 0 to `seconds`.
  void showSecond(int second);
  int second() const { return m_second; }

 signals:
  void changed();  ///< robot, progress, result, problem or second
  /// What the field shows; null: nothing.
  void forecastChanged(const pitchboard::ui::ForecastPtr& forecast);

 private:
  void take(const std::shared_ptr<std::atomic<bool>>& job, double progress,
            const link::ExploreResult& result);
  void end(const std::shared_ptr<std::atomic<bool>>& job, const QString& problem);
  void notify();

  Parts m_parts;
  std::optional<RobotKey> m_robot;
  std::unique_ptr<ExploredMoment> m_found;
  QString m_problem;
  double m_progress = 0.0;
  int m_second = firstSecond;
  /// Of the running exploration: set to cancel it. Null: none runs.
  std::shared_ptr<std::atomic<bool>> m_running;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui
