// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything that the next tick depends on, as one plain value: copy it to save a moment, compare
// it, hash it, put it back. A step is a pure function of this value and the robots' commands.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <base/geometry.h>
#include <base/ids.h>
#include <simcore/world/field.h>
#include <simcore/world/game_state.h>
#include <simcore/world/noise.h>
#include <simcore/world/published_state.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/rigid_body_state.h>
#include <simcore/world/robot_model.h>
#include <simcore/world/team_color.h>

namespace pitchboard::sim {

/// What happens after a goal or when the ball is out, besides what the physics says.
enum class AfterGoal : std::uint8_t {
  StopClock,  ///< as published: the clock stops, the ball stays where it is
  CentreBall  ///< the ball is put on the centre mark and play goes on
};

/// One of the two teams of a match with a referee.
struct TeamSettings {
  TeamColor colour = TeamColor::Blue;
  int number = 0;  ///< in the GameController; 0: a free one
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
  std::optional<RefereeRules> referee;  ///< nothing: the published rules, without a referee
  std::vector<TeamSettings> teams;      ///< at most two; others are the colours on the field
  bool operator==(const SimulationSettings&) const = default;
};

/// The field with the surface that the ball really rolls on: the published physics has its own.
inline FieldSpec playedField(const SimulationSettings& settings) {
  FieldSpec field = settings.field;
  if (settings.physics == "published") field.surface = {};
  return field;
}

struct RobotIdentity {
  RobotId id;
  TeamColor team = TeamColor::Blue;
  int number = 1;               ///< on the shirt
  bool imuStartsAt180 = false;  ///< yaw is relative to 180°, for robots that start facing left
  /// "B1": letter of the team and number on the shirt.
  std::string name() const { return std::string(info(team).letter) + std::to_string(number); }
  bool operator==(const RobotIdentity&) const = default;
};

/// Counted for people; nothing in the physics reads it.
struct RobotStatistics {
  double distanceWalked = 0.0;  ///< m that the gait walked: without the jitter of motion
                                ///< noise, without being pushed or moved by hand
  std::uint32_t kicks = 0;
  std::uint32_t falls = 0;
  std::uint32_t unknownActions = 0;  ///< ticks on which an unknown action code was chosen anew
  int lastUnknownAction = 0;
  bool operator==(const RobotStatistics&) const = default;
};

/// Goals of the team that defends the left and the right goal. `published` calls them friend and
/// enemy goals.
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
  std::uint64_t clockTicks = 0;       ///< ticks on which the clock ran
  std::vector<RobotIdentity> robots;  ///< order of creation; the index of all per-robot vectors
  std::vector<RobotModel> models;     ///< of which kind each robot is
  std::vector<RobotStatistics> statistics;
  std::variant<RigidBodyState, PublishedState> physics;
  std::optional<GameState> game;  ///< exactly when settings.referee is there
  bool operator==(const WorldState&) const = default;
};

/// The radius of robot `index`, m.
inline double robotRadius(const WorldState& world, std::size_t index) {
  const double own = world.models[index].radius;
  return own > 0.0 ? own : world.settings.field.robotRadius;
}

/// 64-bit FNV-1a over every value of the state in declaration order (not over padding), so that two
/// states have the same hash exactly when the simulation goes on in the same way.
std::uint64_t stateHash(const WorldState& state);

}  // namespace pitchboard::sim
