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
  double seconds = 30.0;               ///< that each rollout lasts, 1 to 600
  std::optional<RobotKey> robot;       ///< whose actions are compared; nothing: none
  std::size_t mostRollouts = 1000;     ///< of each action
  std::size_t rolloutsPerRound = 100;  ///< of each action; a result follows each round
  /// Stops before `mostRollouts` once both goal probabilities are known to this much (half of the
  /// 95 % interval) and the best action is clear.
  double precision = 0.02;
  int threads = 1;  ///< 1 to rollout::Rollouts::mostThreads
  std::uint64_t seed = 1;
};

/// A mean with its 95 % confidence interval.
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Something that the chosen robot may do.
struct ExploredAction {
  std::string text;         ///< "Supports"
  Point from;               ///< where its arrow begins: the ball for a kick, else the robot
  std::optional<Point> to;  ///< where its arrow ends; nothing for actions without a target
  Estimate value;           ///< expected goals for minus goals against
  /// By how much it is worse than the best action, from pairs of equal seeds. The intervals of all
  /// actions hold together with 95 % (Bonferroni). Zero for the best action.
  Estimate behind;
  /// The interval of `behind` is above zero.
  bool isWorse() const { return behind.low > 0.0; }
};

/// What is expected a time after the beginning.
struct ExploredTime {
  /// Where the ball is: the share of rollouts in each cell, rows from below, cells from left to
  /// right. A ball outside the lines counts in the nearest cell.
  std::vector<float> heat;
  /// A goal until then, of the team whose own goal is the left or the right one.
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
  /// The best action is better than every other one.
  bool isClear() const;
  /// "Supports is best." or "No significant difference between ..."; empty without actions.
  std::string verdict() const;
};

/// Gets the result so far after each round, and the share of the rollouts that are done (0 to 1).
/// Returning false cancels.
using ExploreProgress = std::function<bool(double done, const ExploreResult& soFar)>;

/// Plays rollouts until they are enough. `cancelled` is looked at between rollouts. A cancelled
/// exploration returns what the finished rounds say, and Conflict if there is none. Fails with
/// InvalidArgument for options out of their ranges, and with NotFound if the chosen robot does not
/// play.
Result<ExploreResult> explore(const ExploreStart& start, const ExploreOptions& options,
                              const ExploreProgress& progress = {},
                              const std::atomic<bool>* cancelled = nullptr);

}  // namespace pitchboard::link
