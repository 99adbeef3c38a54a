// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a match ended for its two teams: the one place that makes it, for command lines, results of
// experiments, reports and scoreboards. Plain values; any thread.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <simcore/world/team_color.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

struct TeamResult {
  TeamColor colour = TeamColor::Blue;
  std::string name{};         ///< the scenario's; empty: it has none
  std::optional<int> number;  ///< the referee's; nothing without one
  Side side = Side::Left;     ///< of the goal that it defends at the end
  int score = 0;              ///< with the goals of a penalty shoot-out
  std::vector<int> byHalf{};  ///< goals of each half that began; empty without a referee
  bool operator==(const TeamResult&) const = default;
};

struct MatchResult {
  /// The referee's teams in their order; without a referee by colour, as in TeamColor.
  std::array<TeamResult, 2> teams;
  std::string endedBy;     ///< "goal", "ball_out", "duration", "full_time", ...
  bool repeatable = true;  ///< the same match played again has the same result
  /// Null if no team plays in this colour.
  const TeamResult* of(TeamColor colour) const;
  bool operator==(const MatchResult&) const = default;
};

/// Of a match that has ended, or of this moment of one.
MatchResult resultOf(const sim::WorldState& world, std::string_view endedBy = {});

/// "RoboFEI"; without a name the colour: "Blue".
std::string titleOf(const TeamResult& team);
/// "RoboFEI (blue) 2 : 1 Red (1 : 0, 1 : 1)", with the goals of each half behind it once there was
/// a second one. Teams of the same colour have their side behind them.
std::string resultText(const MatchResult& result);
/// "1 : 0, 1 : 1"; empty before a second half.
std::string halvesText(const std::vector<int>& first, const std::vector<int>& second);
/// Goals of each half that began, of the team with this index.
std::vector<int> goalsByHalf(const sim::GameState& game, std::size_t team);

}  // namespace pitchboard::link
