// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The colours of teams, as in scenario files, names of robots and referees' packets. Plain values;
// any thread.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pitchboard {

/// First the five colours of the published simulator, which robots have here. Robots of one colour
/// are team-mates. Usually blue (its cyan) and red (its magenta) play a match. Referees know more
/// colours, and may send a code that is none.
enum class TeamColor : std::uint8_t {
  Blue,
  Red,
  Black,
  Orange,
  Yellow,
  White,
  Green,
  Purple,
  Brown,
  Gray,
  Unknown
};

struct TeamColorInfo {
  TeamColor color;
  std::string_view name;    ///< its name in scenario files
  std::string_view letter;  ///< prefix of a robot's name: B1, R2, ...
  bool facesLeft;           ///< a new robot of this colour faces left; its IMU starts at 180°
};

/// The colours that robots may have.
inline constexpr std::array<TeamColorInfo, 5> teamColors{{
    {TeamColor::Blue, "blue", "B", false},
    {TeamColor::Red, "red", "R", true},
    {TeamColor::Black, "black", "K", true},
    {TeamColor::Orange, "orange", "O", true},
    {TeamColor::Yellow, "yellow", "Y", false},
}};
/// What only a referee's teams may have.
inline constexpr std::array<TeamColorInfo, 6> refereeColors{{
    {TeamColor::White, "white", "", false},
    {TeamColor::Green, "green", "", false},
    {TeamColor::Purple, "purple", "", false},
    {TeamColor::Brown, "brown", "", false},
    {TeamColor::Gray, "gray", "", false},
    {TeamColor::Unknown, "unknown", "", false},
}};

/// Reads the name of a colour that robots may have; nothing for any other text.
constexpr std::optional<TeamColor> teamColorNamed(std::string_view name) {
  const auto found = std::ranges::find(teamColors, name, &TeamColorInfo::name);
  return found == teamColors.end() ? std::nullopt : std::optional(found->color);
}

/// Returns the colour if robots may have it.
constexpr std::optional<TeamColor> robotColor(TeamColor color) {
  return static_cast<std::size_t>(color) < teamColors.size() ? std::optional(color) : std::nullopt;
}

constexpr const TeamColorInfo& info(TeamColor color) {
  const auto index = static_cast<std::size_t>(color);
  return index < teamColors.size() ? teamColors[index] : refereeColors[index - teamColors.size()];
}

}  // namespace pitchboard
