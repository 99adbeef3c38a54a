// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Explores what may follow a moment: plays rounds of rollouts from it and summarizes where the ball
// goes, how likely goals are, and which action of a chosen robot is best. The actions of that robot
// are played with the same seeds (common random numbers), so that small differences show. Metres,
// seconds, the studio's frame. Runs on the calling thread and blocks it until done or cancelled.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/explore/explore_start.h>
#include <robotlink/rollout/summary.h>

namespace pitchboard::link {

struct ExploreOptions {
  double seconds = 30.0;               ///< length of a rollout, 1 to 600
  std::optional<RobotKey> robot;       ///< its actions are compared; empty: no actions
  std::size_t mostRollouts = 1000;     ///< of each action
  std::size_t rolloutsPerRound = 100;  ///< of each action; a result follows each round
  /// The exploration ends before `mostRollouts` once half of the 95 % interval of both goal
  /// probabilities is below this and the best action is clear.
  double precision = 0.02;
  int threads = 1;  ///< 1 to rollout::Rollouts::mostThreads
  std::uint64_t seed = 1;
};

/// A mean with its 95 % confidence interval.
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// An action that the chosen robot may take.
struct ExploredAction {
  std::string text;         ///< "Supports"
  Point from;               ///< start of its arrow: the ball for a kick, otherwise the robot
  std::optional<Point> to;  ///< end of its arrow; empty for actions without a target
  Estimate value;           ///< expected goals for minus goals against
  /// The difference to the best action, from pairs of rollouts with equal seeds. With 95 %
  /// probability, the intervals of all actions hold at the same time (Bonferroni). 0 for the best
  /// action.
  Estimate behind;
  /// Returns whether the action is significantly worse than the best one.
  bool isWorse() const { return behind.low > 0.0; }
};

/// What is expected at a time after the beginning.
struct ExploredTime {
  /// The share of rollouts with the ball in each cell, rows from the bottom, cells from left to
  /// right. A ball outside the lines counts in the nearest cell.
  std::vector<float> heat;
  /// The probability of a goal until then by the team that defends the left or the right goal.
  rollout::Share goalLeft, goalRight;
};

struct ExploreResult {
  std::size_t rollouts = 0;  ///< of each action
  double seconds = 30.0;
  int columns = 0, rows = 0;            ///< of the heat maps
  std::vector<ExploredTime> times;      ///< at 0, 1, 2, ... s
  std::vector<ExploredAction> actions;  ///< of the chosen robot, its usual behaviour first
  std::size_t best = 0;                 ///< index of the action with the highest value

  const ExploredTime& last() const { return times.back(); }
  /// Returns whether the best action is significantly better than every other one.
  bool isClear() const;
  /// Returns "Supports is best." or "No significant difference between ..."; empty without actions.
  std::string verdict() const;
};

/// Called after each round with the share of rollouts that are done (0 to 1) and the result so far.
/// Return false to cancel.
using ExploreProgress = std::function<bool(double done, const ExploreResult& soFar)>;

/// Plays rounds of rollouts until the result is precise enough. `cancelled` is read between
/// rollouts. If cancelled, returns the result of the finished rounds, or Conflict if there is none.
/// Fails with InvalidArgument for options out of range, and with NotFound if the chosen robot does
/// not play.
Result<ExploreResult> explore(const ExploreStart& start, const ExploreOptions& options,
                              const ExploreProgress& progress = {},
                              const std::atomic<bool>* cancelled = nullptr);

}  // namespace pitchboard::link
