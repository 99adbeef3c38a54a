// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Many simulated matches of a scenario, stepped together and read as arrays, for learning programs.
// Reference processes run inside, in lock-step; robots without a behaviour are controlled by the
// caller. Arrays have a row for each world and robot, in the order of the scenario. One thread at a
// time; stepping uses further threads, whose number does not change the result.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// A column of an array.
struct WorldColumn {
  std::string_view name;
  std::string_view description;  ///< meaning and unit
};

/// The arrays that can be read, as rows of doubles.
enum class WorldArray {
  /// What a robot sensed in the last tick. NaN for values that were not written, and in worlds that
  /// have not been stepped since their beginning or a snapshot.
  Percepts,
  Robots,  ///< the true state of a robot
  Game     ///< ball, clock and score of a world
};
inline constexpr std::size_t worldArrays = 3;
std::span<const WorldColumn> columnsOf(WorldArray array);
/// Returns the columns of writeCommands(), which are int variables with these names.
std::span<const WorldColumn> commandColumns();

struct WorldsOptions {
  int count = 1;
  int threads = 1;
  std::optional<std::uint64_t> seed;  ///< empty: the scenario's
  std::optional<int> particles;       ///< upper limit for each robot's localization
};

/// A saved world; SimulatedMatch::restore() says what a moment contains.
struct WorldSnapshot {
  Moment moment;
  std::string finishedBy;
};

class Worlds {
 public:
  static constexpr int maxWorlds = 65536;
  static constexpr int maxThreads = 256;
  static constexpr int maxTicks = 100'000'000;  ///< of one step()
  static constexpr int all = -1;                ///< instead of the index of a world
  /// In arrays of ints that are written: keep the current value. In arrays of doubles use NaN.
  static constexpr std::int32_t keep = INT32_MIN;

  /// World i gets the seed of world 0 plus i. Fails if the scenario is invalid, a number is out of
  /// range, or a robot is controlled by a separate program.
  static Result<Worlds> create(const Scenario& scenario, const WorldsOptions& options);
  Worlds(Worlds&&) noexcept;
  Worlds& operator=(Worlds&&) noexcept;
  ~Worlds();

  std::size_t count() const;
  std::size_t robots() const;  ///< in each world
  double tickRate() const;
  std::span<const RobotId> robotIds() const;

  /// Sets the behaviour of a robot in all worlds, also after resets; with noBehaviour the caller
  /// controls it.
  Result<void> setBehaviour(RobotId robot, const std::string& behaviour);
  /// Restarts the scenario with this seed. With `all`, world i gets the seed plus i.
  Result<void> reset(int world, std::uint64_t seed);
  /// Restarts some worlds, each with its own seed.
  Result<void> reset(std::span<const int> worlds, std::span<const std::uint64_t> seeds);
  /// Advances all worlds by this many ticks. A world whose scenario has ended no longer changes.
  Result<void> step(int ticks);
  /// Returns "goal", "ball_out", "duration" or "full_time"; empty while the scenario continues.
  std::string_view finishedBy(std::size_t world) const;

  // Shapes: percepts and robots [worlds][robots][columns], game [worlds][columns], variables
  // [worlds][robots][variables], boards [worlds][robots][512], hashes [worlds], commands
  // [worlds][robots][columns], actions [worlds][robots]. All fail if the size does not match.
  std::size_t sizeOf(WorldArray array) const;
  Result<void> read(WorldArray array, std::span<double> out) const;
  Result<void> readBoards(std::span<std::uint32_t> out) const;
  Result<void> readVariables(std::span<const Variable> variables, std::span<double> out) const;
  Result<void> readHashes(std::span<std::uint64_t> out) const;
  /// Int variables accept whole numbers of 32 bits only.
  Result<void> writeVariables(std::span<const Variable> variables, std::span<const double> values);
  Result<void> writeCommands(std::span<const std::int32_t> commands);
  /// Writes DECISION_ACTION_A.
  Result<void> writeActions(std::span<const std::int32_t> actions);

  // Moving robots and ball; `world` may be `all`.
  Result<void> placeRobot(int world, RobotId robot, const Pose& pose);
  Result<void> placeBall(int world, const Point& place, const Velocity& velocity);
  // The same in several worlds, one place for each. If a world does not exist, nothing is moved.
  Result<void> placeRobots(std::span<const int> worlds, RobotId robot, std::span<const Pose> poses);
  Result<void> placeBalls(std::span<const int> worlds, std::span<const Point> places,
                          std::span<const Velocity> velocities);

  Result<WorldSnapshot> snapshot(int world) const;
  /// Restores a snapshot, also of another world or of other Worlds with the same scenario.
  Result<void> restore(int world, const WorldSnapshot& snapshot);
  /// Restores the snapshot in each of `worlds`, which then continues with the noise of its own
  /// seed.
  Result<void> restore(std::span<const int> worlds, std::span<const std::uint64_t> seeds,
                       const WorldSnapshot& snapshot);

 private:
  struct Parts;
  explicit Worlds(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> m_parts;
};

/// Finds a variable of the published map. Error NotFound suggests similar names.
Result<Variable> worldVariable(std::string_view name);

}  // namespace pitchboard::link
