// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The complete state of the simulated world, as one plain value: copy it to save a moment, compare
// it, hash it, restore it. A step is a pure function of this value and the robots' commands.
// Metres, radians, ticks; any thread.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <base/game.h>
#include <base/geometry.h>
#include <base/ids.h>
#include <base/team_color.h>
#include <simcore/world/field.h>
#include <simcore/world/noise.h>
#include <simcore/world/published_state.h>
#include <simcore/world/referee_memory.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/rigid_body_state.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::sim {

/// What happens after a goal.
enum class AfterGoal : std::uint8_t {
  StopClock,  ///< as published: the clock stops, the ball stays where it is
  CentreBall  ///< the ball is put on the centre mark and play continues
};

/// One of the two teams of a match with a referee.
struct TeamSettings {
  TeamColor colour = TeamColor::Blue;
  int number = 0;  ///< number in the GameController; 0: any free one
  std::string name;
  bool operator==(const TeamSettings&) const = default;
};

struct SimulationSettings {
  std::string physics = "rigid-body";  ///< a name of physicsModels()
  double tickRate = 60.0;              ///< ticks per simulated second
  std::uint64_t seed = 1;
  FieldSpec field;
  NoiseParameters noise;
  AfterGoal afterGoal = AfterGoal::CentreBall;
  RigidBodySettings rigidBody;
  std::optional<RefereeRules> referee;  ///< nothing: no referee, the published rules
  std::vector<TeamSettings> teams;      ///< at most two; missing ones are the colours on the field
  bool operator==(const SimulationSettings&) const = default;
};

/// Returns the field with the surface that is really used; the published physics has its own.
inline FieldSpec playedField(const SimulationSettings& settings) {
  FieldSpec field = settings.field;
  if (settings.physics == "published") field.surface = {};
  return field;
}

struct RobotIdentity {
  RobotId id;
  TeamColor team = TeamColor::Blue;
  int number = 1;               ///< number on the shirt
  bool imuStartsAt180 = false;  ///< its yaw counts from 180°, for robots that start facing left
  /// Returns the letter of the team and the number on the shirt: "B1".
  std::string name() const { return std::string(info(team).letter) + std::to_string(number); }
  bool operator==(const RobotIdentity&) const = default;
};

/// Statistics for people; the physics does not read them.
struct RobotStatistics {
  double distanceWalked = 0.0;  ///< m that the gait walked, without motion noise,
                                ///< pushes and moves by hand
  std::uint32_t kicks = 0;
  std::uint32_t falls = 0;
  std::uint32_t unknownActions = 0;  ///< how often an unknown action code was chosen
  int lastUnknownAction = 0;
  bool operator==(const RobotStatistics&) const = default;
};

/// Goals of the team that defends the left goal and of the one that defends the right goal.
struct Score {
  int left = 0;
  int right = 0;
  bool operator==(const Score&) const = default;
};

struct WorldState {
  SimulationSettings settings;
  std::uint64_t tick = 0;
  Score score;
  bool clockRunning = true;
  std::uint64_t clockTicks = 0;  ///< ticks for which the clock has run
  std::vector<RobotIdentity>
      robots;                      ///< in order of creation; all per-robot vectors use this index
  std::vector<RobotModel> models;  ///< model of each robot
  std::vector<RobotStatistics> statistics;
  std::variant<RigidBodyState, PublishedState> physics;
  std::optional<Game> game;  ///< present exactly if settings.referee is
  RefereeMemory refereeMemory;
  bool operator==(const WorldState&) const = default;
};

/// What ticks change in a world without a referee, and the seed. Many worlds that have all the rest
/// in common are kept as their courses, next to each other in memory, and played in turn by one
/// Simulation (Simulation::exchange()).
struct WorldCourse {
  std::uint64_t seed = 1;
  std::uint64_t tick = 0;
  Score score;
  bool clockRunning = true;
  std::uint64_t clockTicks = 0;
  std::vector<RobotStatistics> statistics;
  std::variant<RigidBodyState, PublishedState> physics;
};

/// Returns the radius of robot `index` in m.
inline double robotRadius(const WorldState& world, std::size_t index) {
  const double own = world.models[index].radius;
  return own > 0.0 ? own : world.settings.field.robotRadius;
}

/// Returns the 64-bit FNV-1a hash over every value of the state in order of declaration, without
/// padding. Two states with the same hash continue in the same way.
std::uint64_t stateHash(const WorldState& state);

}  // namespace pitchboard::sim
