// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the result of a match for its two teams. The command line, experiments, reports and
// scoreboards all use it. Plain values; any thread.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/team_color.h>
#include <robotlink/frame/match_event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

struct TeamResult {
  TeamColor colour = TeamColor::Blue;
  std::string name{};         ///< from the scenario; empty: none
  std::optional<int> number;  ///< the referee's number; empty without a referee
  Side side = Side::Left;     ///< the side that the team defends at the end
  int score = 0;              ///< includes goals of a penalty shoot-out
  std::vector<int> byHalf{};  ///< goals in each half that has started; empty without a referee
  bool wonToss = false;       ///< a coin decided the shoot-out for this team
  bool operator==(const TeamResult&) const = default;
};

struct MatchResult {
  /// In the referee's order; without a referee in the order of TeamColor.
  std::array<TeamResult, 2> teams;
  std::string endedBy;     ///< "goal", "ball_out", "duration", "full_time", ...
  bool repeatable = true;  ///< playing the match again gives the same result
  /// Returns null if no team plays in this colour.
  const TeamResult* of(TeamColor colour) const;
  bool operator==(const MatchResult&) const = default;
};

/// Returns the result at this moment, of a match that has ended or is still being played.
MatchResult resultOf(const sim::WorldState& world, std::string_view endedBy = {});

/// Returns the team's name, or its colour if it has no name: "RoboFEI", "Blue".
std::string titleOf(const TeamResult& team);
/// Returns "RoboFEI (blue) 2 : 1 Red (1 : 0, 1 : 1)". The goals of each half are added once there
/// was a second half, and who won the toss if a coin decided; the side is added if both teams have
/// the same colour.
std::string resultText(const MatchResult& result);
/// Returns "1 : 0, 1 : 1"; empty before the second half.
std::string halvesText(const std::vector<int>& first, const std::vector<int>& second);
/// Returns the goals of the team with this index in each half that has started.
std::vector<int> goalsByHalf(const Game& game, std::size_t team);

}  // namespace pitchboard::link
