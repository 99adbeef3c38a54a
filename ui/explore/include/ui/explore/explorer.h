// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Explores the moment that the studio shows, of a simulated, live or recorded match, on a thread of
// its own: where the ball may go and how likely goals are. It only reads frames; nothing is sent
// to a robot. UI thread only; owned by the window.

#include <QObject>
#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include <base/team_color.h>
#include <robotlink/explore/explore.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/ball_heat.h>

namespace pitchboard::ui {

class MatchController;
class ReplayController;
class ShownMoment;

/// What an exploration has found so far.
struct ExploredMoment {
  double time = 0.0;  ///< s of the source
  link::ExploreStart start;
  link::ExploreResult result;                     ///< empty until the first round is played
  std::array<std::optional<TeamColor>, 2> teams;  ///< that defend the left and right goal
};

class Explorer : public QObject {
  Q_OBJECT
 public:
  static constexpr int seconds = 30;
  static constexpr int firstSecond = 5;  ///< the time whose heat map is shown first

  /// All must outlive the explorer.
  struct Parts {
    ShownMoment* shown = nullptr;
    const MatchController* match = nullptr;
    const ReplayController* replay = nullptr;
  };
  Explorer(const Parts& parts, QObject* parent);
  /// Cancels, and waits for the thread.
  ~Explorer() override;

  /// Explores the moment shown, also while looking back. A running exploration is cancelled.
  void start();
  /// Stops the exploration. The result so far is kept.
  void cancel();
  /// Stops the exploration and forgets its result.
  void clear();
  bool isRunning() const { return m_running != nullptr; }
  /// Returns the progress of the running exploration, 0 to 1.
  double progress() const { return m_progress; }
  /// Returns the result so far; null before the first exploration and after clear().
  const ExploredMoment* found() const { return m_found.get(); }
  /// Returns why the last exploration has no result; empty if it has one.
  const QString& problem() const { return m_problem; }

  /// Chooses the time after the moment (0 to `seconds`) whose heat map the field shows.
  void showSecond(int second);
  int second() const { return m_second; }

 signals:
  void changed();  ///< progress, result, problem or second
  /// The field has to show this heat map; null: none.
  void heatChanged(const pitchboard::ui::BallHeatPtr& heat);

 private:
  void take(const std::shared_ptr<std::atomic<bool>>& job, double progress,
            const link::ExploreResult& result);
  void end(const std::shared_ptr<std::atomic<bool>>& job, const QString& problem);
  void notify();

  Parts m_parts;
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
