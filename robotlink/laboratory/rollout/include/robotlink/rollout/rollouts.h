// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays many short games from a belief, thousands of times faster than real time, to find out how a
// situation may develop. Both teams use the behaviours of the decision and planning processes.
// Bodies walk, kick and roll by the formulas of the rigid-body model. Believed poses have errors
// like those of localization. There are no blackboards, particles or referee: a rollout ends with a
// goal, when the ball is out, or after its time (docs/rollouts.md). Metres, radians, seconds.
//
// The outcome of a rollout depends only on setup, belief, options and seed, not on other rollouts,
// the number of threads or the tile size. It is not bit-identical to a simulated match.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <base/result.h>
#include <robotlink/rollout/belief.h>

namespace pitchboard::rollout {

/// The columns of a row of outcomes; columns() describes them.
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
  NearLeft,
  NearRight,
  Count
};
inline constexpr std::size_t columnCount = static_cast<std::size_t>(Column::Count);
struct OutcomeColumn {
  std::string_view name;         ///< such as "time_to_goal"
  std::string_view description;  ///< meaning and unit
};
std::span<const OutcomeColumn, columnCount> columns();

/// The values of Column::EndedBy.
enum class Ended : std::uint8_t { Time, Goal, BallOut };

struct PlayOptions {
  double seconds = 10.0;
  double look = 5.0;  ///< s; LookX and LookY are the ball's position then, or at an earlier end
  /// If true, a goal or a ball that is out does not end a rollout: the ball is put on the centre
  /// mark or 1 m inside the line.
  bool goOn = false;
  double traceEvery = 1.0;  ///< s between two points of a trace
};

/// A moment of one rollout.
struct TracePoint {
  Point ball;
  int goalsLeft = 0, goalsRight = 0;  ///< since the beginning, as Column::GoalsLeft
};
/// Returns how many points a rollout has in a trace: its beginning, and then one every `traceEvery`
/// seconds.
std::size_t tracePoints(const PlayOptions& options);

struct RolloutsOptions {
  int threads = 1;
  int tile = 1;  ///< number of worlds that a thread steps together
};

class Rollouts {
 public:
  static constexpr int maxThreads = 256, maxTile = 4096;
  static constexpr std::size_t maxPlayers = 22;
  static constexpr double longest = 600.0;  ///< s

  /// Fails if a number is out of range, there are too many players, or a behaviour does not use the
  /// pose.
  static Result<Rollouts> create(const Setup& setup, const RolloutsOptions& options = {});
  Rollouts(Rollouts&&) noexcept;
  Rollouts& operator=(Rollouts&&) noexcept;
  ~Rollouts();

  std::size_t players() const;

  /// Plays a rollout for each seed and writes a row of columnCount numbers for each to `out`. Equal
  /// seeds have equal noise, whatever the belief. Fails before playing if the belief does not match
  /// the players, contains a number that is not finite, or `out` has the wrong size. `cancelled` is
  /// checked between tiles; rows that were not played are NaN. `trace` is empty or has
  /// tracePoints() for each seed; a rollout that ends early repeats its last point. With one
  /// thread, it allocates nothing after the first call.
  Result<void> play(const Belief& belief, std::span<const std::uint64_t> seeds,
                    const PlayOptions& options, std::span<double> out,
                    const std::atomic<bool>* cancelled = nullptr, std::span<TracePoint> trace = {});

 private:
  struct Parts;
  explicit Rollouts(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::rollout
