// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Explores what may follow a moment: plays rounds of rollouts from it and counts where the ball
// goes and how often there is a goal. Metres, seconds, the studio's frame. Runs on the calling
// thread and blocks it until done or cancelled.

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include <base/result.h>
#include <robotlink/explore/explore_start.h>

namespace pitchboard::link {

struct ExploreOptions {
  double seconds = 30.0;  ///< length of a rollout, 1 to 600
  std::size_t maxRollouts = 1000;
  std::size_t rolloutsPerRound = 100;  ///< a result follows each round
  /// The exploration ends before `maxRollouts` once half of the 95 % interval of both goal
  /// probabilities is below this.
  double precision = 0.02;
  int threads = 1;  ///< 1 to rollout::Rollouts::maxThreads
  std::uint64_t seed = 1;
};

/// A share of 1 with its 95 % confidence interval (Wilson).
struct Share {
  double value = 0.0, low = 0.0, high = 1.0;
};
/// Returns the share of `hits` in `count` trials.
Share shareOf(double hits, double count);

/// What is expected at a time after the beginning.
struct ExploredTime {
  /// The share of rollouts with the ball in each cell, rows from the bottom, cells from left to
  /// right. A ball outside the lines counts in the nearest cell.
  std::vector<float> heat;
  /// The probability of a goal until then by the team that defends the left or the right goal.
  Share goalLeft, goalRight;
};

struct ExploreResult {
  std::size_t rollouts = 0;
  double seconds = 30.0;
  int columns = 0, rows = 0;        ///< of the heat maps
  std::vector<ExploredTime> times;  ///< at 0, 1, 2, ... s

  const ExploredTime& last() const { return times.back(); }
};

/// Called after each round with the share of rollouts that are done (0 to 1) and the result so far.
/// Return false to cancel.
using ExploreProgress = std::function<bool(double done, const ExploreResult& soFar)>;

/// Plays rounds of rollouts until the result is precise enough. `cancelled` is read between
/// rollouts. If cancelled, returns the result of the finished rounds, or Conflict if there is none.
/// Fails with InvalidArgument for options out of range.
Result<ExploreResult> explore(const ExploreStart& start, const ExploreOptions& options,
                              const ExploreProgress& progress = {},
                              const std::atomic<bool>* cancelled = nullptr);

}  // namespace pitchboard::link
