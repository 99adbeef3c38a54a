// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Team colours as scenario files and robots' names have them. Values; any thread.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pitchboard {

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

/// Of "blue"; nothing for any other text, also for colours that robots cannot be drawn in.
constexpr std::optional<TeamColor> teamColorNamed(std::string_view name) {
  const auto found = std::ranges::find(teamColors, name, &TeamColorInfo::name);
  return found == teamColors.end() ? std::nullopt : std::optional(found->color);
}

constexpr const TeamColorInfo& info(TeamColor color) {
  return teamColors[static_cast<std::size_t>(color)];
}

}  // namespace pitchboard
