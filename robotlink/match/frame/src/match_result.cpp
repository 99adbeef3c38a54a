// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/match_result.h>

#include <algorithm>
#include <cctype>

#include <robotlink/frame/teams.h>

namespace pitchboard::link {
namespace {

std::string resultTitle(const TeamResult& team, bool withSide) {
  std::string more(withSide ? sideName(team.side) : info(team.colour).name);
  if (team.name.empty() && !withSide) return titleOf(team);
  return titleOf(team) + " (" + more + ')';
}

}  // namespace

const TeamResult* MatchResult::of(TeamColor colour) const {
  const auto found = std::ranges::find(teams, colour, &TeamResult::colour);
  return found == teams.end() ? nullptr : &*found;
}

std::vector<int> goalsByHalf(const Game& game, std::size_t team) {
  constexpr std::size_t normalTime = 2;
  const auto& goals = game.teams[team].byHalf;
  std::size_t count = normalTime;
  if (const auto period = game.period()) {
    count = *period + 1;
  } else if (std::ranges::any_of(game.teams, [](const GameTeam& one) {
               return one.byHalf[normalTime] + one.byHalf[normalTime + 1] > 0;
             })) {
    count = goals.size();
  }
  return {goals.begin(), goals.begin() + static_cast<std::ptrdiff_t>(count)};
}

MatchResult resultOf(const sim::WorldState& world, std::string_view endedBy) {
  MatchResult out;
  out.endedBy = endedBy;
  if (world.game) {
    const Game& game = *world.game;
    for (std::size_t i = 0; i < out.teams.size(); ++i) {
      const GameTeam& team = game.teams[i];
      out.teams[i] = {team.colour, {},
                      team.number, i == game.leftTeam() ? Side::Left : Side::Right,
                      team.score,  goalsByHalf(game, i)};
    }
  } else {
    for (const Side side : {Side::Left, Side::Right}) {
      TeamResult& team = out.teams[static_cast<std::size_t>(side)];
      team.colour = teamOn(side, world.robots);
      team.side = side;
      team.score = side == Side::Left ? world.score.left : world.score.right;
    }
    if (out.teams[1].colour < out.teams[0].colour) std::swap(out.teams[0], out.teams[1]);
  }
  for (TeamResult& team : out.teams) {
    const auto& known = world.settings.teams;
    const auto named = std::ranges::find(known, team.colour, &sim::TeamSettings::colour);
    if (named != known.end()) team.name = named->name;
  }
  return out;
}

std::string titleOf(const TeamResult& team) {
  if (!team.name.empty()) return team.name;
  std::string out(info(team.colour).name);
  out.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(out.front())));
  return out;
}

std::string resultText(const MatchResult& result) {
  const auto& [first, second] = result.teams;
  const bool alike = first.colour == second.colour;
  const std::string halves = halvesText(first.byHalf, second.byHalf);
  std::string out = resultTitle(first, alike) + ' ' + std::to_string(first.score) + " : " +
                    std::to_string(second.score) + ' ' + resultTitle(second, alike) +
                    (halves.empty() ? halves : " (" + halves + ')');
  for (const TeamResult& team : result.teams) {
    if (team.wonToss) out += ", " + titleOf(team) + " won the toss";
  }
  return out;
}

std::string halvesText(const std::vector<int>& first, const std::vector<int>& second) {
  std::string out;
  const std::size_t count = std::min(first.size(), second.size());
  for (std::size_t i = 0; count > 1 && i < count; ++i) {
    out += (i == 0 ? "" : ", ") + std::to_string(first[i]) + " : " + std::to_string(second[i]);
  }
  return out;
}

}  // namespace pitchboard::link
