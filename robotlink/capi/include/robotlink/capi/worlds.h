// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Many simulated matches of one scenario, stepped together and read as arrays: what learning
// programs work with. Robots' reference processes run inside, in lock-step; a robot without a
// behaviour is the caller's. Arrays have one row per world and robot, in the order of the scenario.
// For one thread at a time; stepping uses more of its own, with the same result for any number.

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

/// A number of a row: its name, and for people what it is, with its unit.
struct WorldColumn {
  std::string_view name;
  std::string_view words;
};

/// What can be read of worlds, as rows of doubles.
enum class WorldArray {
  /// Of each robot: what its last tick let it sense; NaN where nothing was written, and of a world
  /// that has not been stepped since its beginning or a snapshot.
  Percepts,
  Robots,  ///< of each robot: the truth
  Game     ///< of each world: ball, clock, score
};
inline constexpr std::size_t worldArrays = 3;
std::span<const WorldColumn> columnsOf(WorldArray array);
/// What a robot is told: the columns of writeCommands(), int variables of these names.
std::span<const WorldColumn> commandColumns();

struct WorldsOptions {
  int count = 1;
  int threads = 1;
  std::optional<std::uint64_t> seed;  ///< nothing: the scenario's
  std::optional<int> particles;       ///< at most, of each robot that localizes itself
};

/// A world as it was; see SimulatedMatch::restore() for what belongs to a moment.
struct WorldSnapshot {
  Moment moment;
  std::string finishedBy;
};

class Worlds {
 public:
  static constexpr int mostWorlds = 65536;
  static constexpr int mostThreads = 256;
  static constexpr int mostTicks = 100'000'000;  ///< of one step()
  static constexpr int all = -1;                 ///< in place of a world
  /// Values of these leave what stands there.
  static constexpr std::int32_t keep = INT32_MIN;  ///< an int; a double is left out by NaN

  /// World i has the seed of world 0 plus i. Fails as loading a scenario does, on numbers out of
  /// bounds, and when a robot is to be played by a program.
  static Result<Worlds> create(const Scenario& scenario, const WorldsOptions& options);
  Worlds(Worlds&&) noexcept;
  Worlds& operator=(Worlds&&) noexcept;
  ~Worlds();

  std::size_t count() const;
  std::size_t robots() const;  ///< of each world
  double tickRate() const;
  std::span<const RobotId> robotIds() const;

  /// Who decides for a robot in every world from now on, after resets, too: a behaviour of ours, or
  /// noBehaviour.
  Result<void> setBehaviour(RobotId robot, const std::string& behaviour);
  /// The beginning of the scenario with this seed; of all: world i with the seed plus i.
  Result<void> reset(int world, std::uint64_t seed);
  /// The same of some, each with a seed of its own.
  Result<void> reset(std::span<const int> worlds, std::span<const std::uint64_t> seeds);
  /// So many ticks of every world; a world whose scenario is over stops there and stands still.
  Result<void> step(int ticks);
  /// "goal", "ball_out", "duration", "full_time"; empty while the world goes on.
  std::string_view finishedBy(std::size_t world) const;

  // Shapes: percepts and robots [worlds][robots][columns], game [worlds][columns], variables
  // [worlds][robots][variables], boards [worlds][robots][512], hashes [worlds], commands
  // [worlds][robots][columns], actions [worlds][robots]. All fail when the size is another one.
  std::size_t sizeOf(WorldArray array) const;
  Result<void> read(WorldArray array, std::span<double> out) const;
  Result<void> readBoards(std::span<std::uint32_t> out) const;
  Result<void> readVariables(std::span<const Variable> variables, std::span<double> out) const;
  Result<void> readHashes(std::span<std::uint64_t> out) const;
  /// Ints take whole numbers of 32 bits.
  Result<void> writeVariables(std::span<const Variable> variables, std::span<const double> values);
  Result<void> writeCommands(std::span<const std::int32_t> commands);
  /// DECISION_ACTION_A.
  Result<void> writeActions(std::span<const std::int32_t> actions);

  // Moving by hand, in metres, radians and m/s; `world` may be `all`.
  Result<void> placeRobot(int world, RobotId robot, const Pose& pose);
  Result<void> placeBall(int world, const Point& place, const Velocity& velocity);
  /// Many at once: one place for each of `worlds`. Nothing is moved when a world is not there.
  Result<void> placeRobots(std::span<const int> worlds, RobotId robot, std::span<const Pose> poses);
  Result<void> placeBalls(std::span<const int> worlds, std::span<const Point> places,
                          std::span<const Velocity> velocities);

  Result<WorldSnapshot> snapshot(int world) const;
  /// Also into another world, and into other worlds of the same scenario.
  Result<void> restore(int world, const WorldSnapshot& snapshot);
  /// The same state in each of `worlds`, from which each goes on with the noise of its own seed.
  Result<void> restore(std::span<const int> worlds, std::span<const std::uint64_t> seeds,
                       const WorldSnapshot& snapshot);

 private:
  struct Parts;
  explicit Worlds(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> m_parts;
};

/// A variable of the published map; NotFound with names that are near.
Result<Variable> worldVariable(std::string_view name);

}  // namespace pitchboard::link
