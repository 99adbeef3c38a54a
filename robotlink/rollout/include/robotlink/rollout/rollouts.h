// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Many short games from one belief, thousands of times faster than real time: what may become of a
// situation. Both teams play with the very behaviours of the decision and planning processes,
// bodies walk, kick and roll by the formulas of the rigid-body model, and what a robot believes
// errs as its localization would. There are no blackboards, no particles and no referee: a rollout
// ends with a goal, with the ball out, or with its time (docs/rollouts.md).
//
// A rollout depends on belief and seed only: on no other rollout, and neither on the number of
// threads nor on how many worlds a thread steps together. It has not the hash of a match.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <base/result.h>
#include <robotlink/rollout/belief.h>

namespace pitchboard::rollout {

/// A number of a row of outcomes.
enum class Column : std::uint8_t {
  Seed,
  EndedBy,
  Time,
  GoalsLeft,
  GoalsRight,
  TimeToGoal,
  BallX,
  BallY,
  BallVx,
  BallVy,
  LookX,
  LookY,
  LastTouch,
  Count
};
inline constexpr std::size_t columnCount = static_cast<std::size_t>(Column::Count);
struct ColumnInfo {
  std::string_view name;   ///< "time_to_goal"
  std::string_view words;  ///< what it is, with its unit
};
std::span<const ColumnInfo, columnCount> columns();

/// Of Column::EndedBy.
enum class Ended : std::uint8_t { Time, Goal, BallOut };

struct PlayOptions {
  double seconds = 10.0;
  double look = 5.0;  ///< s: LookX and LookY are the ball's then, or where the rollout ended before
  /// After a goal the ball lies on the centre mark, outside 1 m inside, and the game goes on.
  bool goOn = false;
  double traceEvery = 1.0;  ///< s between two points of a trace
};

/// A moment of one rollout.
struct TracePoint {
  Point ball;
  int goalsLeft = 0, goalsRight = 0;  ///< since the beginning, as Column::GoalsLeft
};
/// Points that a rollout has in a trace: its beginning, and then one every `traceEvery` seconds.
std::size_t tracePoints(const PlayOptions& options);

struct RolloutsOptions {
  int threads = 1;
  int tile = 1;  ///< worlds that a thread steps together
};

class Rollouts {
 public:
  static constexpr int mostThreads = 256, mostTile = 4096;
  static constexpr std::size_t mostPlayers = 22;
  static constexpr double longest = 600.0;  ///< s

  /// Fails on numbers out of their ranges, more players than 22, and behaviours that play without
  /// a pose.
  static Result<Rollouts> create(const Setup& setup, const RolloutsOptions& options = {});
  Rollouts(Rollouts&&) noexcept;
  Rollouts& operator=(Rollouts&&) noexcept;
  ~Rollouts();

  std::size_t players() const;

  /// Plays one rollout for each seed into `out`, a row of columnCount for each. The same seed is
  /// the same noise, whatever the belief. Fails before it plays, on a belief of other players or
  /// with numbers that are not finite, and when `out` has another size. `cancelled` is looked at
  /// between tiles; rows that were not played are NaN. `trace` is empty or has tracePoints() for
  /// each seed; a rollout that ends early repeats its last point. With one thread it allocates
  /// nothing after the first call.
  Result<void> play(const Belief& belief, std::span<const std::uint64_t> seeds,
                    const PlayOptions& options, std::span<double> out,
                    const std::atomic<bool>* cancelled = nullptr, std::span<TracePoint> trace = {});

 private:
  struct Parts;
  explicit Rollouts(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::rollout
