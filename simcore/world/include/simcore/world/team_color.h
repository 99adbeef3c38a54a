// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The colours of teams, as in scenario files and names of robots. Plain values; any thread.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pitchboard {

/// The five colours of the published simulator. Robots of one colour are team-mates. Usually blue
/// (its cyan) and red (its magenta) play a match.
enum class TeamColor : std::uint8_t { Blue, Red, Black, Orange, Yellow };

struct TeamColorInfo {
  TeamColor color;
  std::string_view name;    ///< its name in scenario files
  std::string_view letter;  ///< prefix of a robot's name: B1, R2, ...
  bool facesLeft;           ///< a new robot of this colour faces left; its IMU starts at 180°
};

inline constexpr std::array<TeamColorInfo, 5> teamColors{{
    {TeamColor::Blue, "blue", "B", false},
    {TeamColor::Red, "red", "R", true},
    {TeamColor::Black, "black", "K", true},
    {TeamColor::Orange, "orange", "O", true},
    {TeamColor::Yellow, "yellow", "Y", false},
}};

/// Reads "blue" and so on; nothing for any other text.
constexpr std::optional<TeamColor> teamColorNamed(std::string_view name) {
  const auto found = std::ranges::find(teamColors, name, &TeamColorInfo::name);
  return found == teamColors.end() ? std::nullopt : std::optional(found->color);
}

constexpr const TeamColorInfo& info(TeamColor color) {
  return teamColors[static_cast<std::size_t>(color)];
}

}  // namespace pitchboard
