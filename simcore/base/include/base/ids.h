// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of things that several libraries share.

#include <array>
#include <compare>
#include <cstdint>
#include <string_view>

namespace pitchboard {

/// The number of a robot's blackboard and of its telemetry port: 1, 2, ... unique on one field.
/// (The number on its shirt is unique within its team only.)
struct RobotId {
  int value = 0;
  auto operator<=>(const RobotId&) const = default;
};

/// Robots with higher numbers have no blackboard, telemetry port and team.
inline constexpr int highestRobotNumber = 64;

/// The five colours of the published simulator. Blue (its cyan) and red (its magenta) play a match;
/// the others are for further groups of robots. Robots of one colour are team-mates.
enum class TeamColor : std::uint8_t { Blue, Red, Black, Orange, Yellow };

struct TeamColorInfo {
  TeamColor color;
  std::string_view name;    ///< as in a scenario file
  std::string_view letter;  ///< prefix of a robot's name: B1, R2, ...
  bool facesLeft;           ///< how a new robot of this colour stands; its IMU then starts at 180°
};

inline constexpr std::array<TeamColorInfo, 5> teamColors{{
    {TeamColor::Blue, "blue", "B", false},
    {TeamColor::Red, "red", "R", true},
    {TeamColor::Black, "black", "K", true},
    {TeamColor::Orange, "orange", "O", true},
    {TeamColor::Yellow, "yellow", "Y", false},
}};

constexpr const TeamColorInfo& info(TeamColor color) {
  return teamColors[static_cast<std::size_t>(color)];
}

}  // namespace pitchboard
