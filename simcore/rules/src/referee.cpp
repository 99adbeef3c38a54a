// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/rules/referee.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <base/try.h>
#include <simcore/world/referee_parameters.h>

#include "referee_table.h"

namespace pitchboard::sim {

namespace {

/// Those of the settings, then the colours on the field, then blue and red.
Result<std::array<GameTeam, 2>> teamsOf(const WorldState& world) {
  std::vector<TeamSettings> teams = world.settings.teams;
  const auto has = [&teams](TeamColor colour) {
    return std::ranges::any_of(teams, [&](const TeamSettings& t) { return t.colour == colour; });
  };
  for (const TeamColorInfo& one : teamColors) {
    const bool plays = std::ranges::any_of(
        world.robots, [&](const RobotIdentity& robot) { return robot.team == one.color; });
    if (plays && !has(one.color)) teams.push_back({one.color, 0, {}});
  }
  if (teams.size() > 2) {
    std::string colours;
    for (const TeamSettings& team : teams) {
      colours += (colours.empty() ? "" : ", ") + std::string(info(team.colour).name);
    }
    return failure(ErrorCode::InvalidArgument,
                   "A match with a referee needs two teams, but here are " + colours +
                       "; remove the robots of the others, or play without a referee.",
                   "teams");
  }
  for (const TeamColor usual : {TeamColor::Blue, TeamColor::Red}) {
    if (teams.size() < 2 && !has(usual)) teams.push_back({usual, 0, {}});
  }
  std::array<GameTeam, 2> out;
  for (std::size_t i = 0; i < 2; ++i) {
    const int other = teams[1 - i].number;
    out[i].colour = teams[i].colour;
    out[i].number = teams[i].number;
    if (out[i].number == 0) out[i].number = static_cast<int>(i) + (other == int(i) + 1 ? 2 : 1);
  }
  if (out[0].colour == out[1].colour || out[0].number == out[1].number) {
    return failure(ErrorCode::InvalidArgument,
                   "The two teams need different colours and different numbers.", "teams");
  }
  return out;
}

}  // namespace

Result<GameState> newGame(WorldState& world, const Snapshot& now) {
  const RefereeRules& rules = *world.settings.referee;
  const double rate = world.settings.tickRate;
  GameState game;
  auto teams = teamsOf(world);
  if (!teams) return tl::unexpected(teams.error());
  game.teams = *teams;
  game.clock = static_cast<int>(std::lround(rules.halfTime * rate));
  game.breakLeft = static_cast<int>(std::lround(rules.beforeMatch * rate));
  game.watches.resize(world.robots.size());
  giveSlots(world.robots, game);
  // Who attacks where is what the first robot of a team was told.
  if (!world.robots.empty()) {
    const RobotIdentity& first = world.robots.front();
    game.swapped = first.imuStartsAt180 != (game.teamOf(first.team) == 1);
  }
  for (int t = 0; t < 2; ++t) {
    GameTeam& team = game.teams[static_cast<std::size_t>(t)];
    const bool right = game.attacksRight(static_cast<std::size_t>(t));
    const double goal = (right ? -1.0 : 1.0) * world.settings.field.halfLength();
    double nearest = std::numeric_limits<double>::max();
    int keeper = 0;
    for (std::size_t i = 0; i < world.robots.size(); ++i) {
      RobotIdentity& robot = world.robots[i];
      if (robot.team != team.colour) continue;
      robot.imuStartsAt180 = !right;
      const double d = squared(now.robots[i].pose.position, {goal, 0.0});
      const int slot = team.slotOf(robot.number);
      if (slot == 0 || d >= nearest) continue;
      nearest = d;
      keeper = slot;
    }
    if (keeper > 0) team.players[static_cast<std::size_t>(keeper - 1)].goalkeeper = true;
  }
  return game;
}

void giveSlots(std::span<const RobotIdentity> robots, GameState& game) {
  for (GameTeam& team : game.teams) {
    const auto wears = [&](int shirt) {
      return std::ranges::any_of(robots, [&](const RobotIdentity& robot) {
        return robot.team == team.colour && robot.number == shirt;
      });
    };
    for (const RobotIdentity& robot : robots) {
      if (robot.team != team.colour || team.slotOf(robot.number) != 0) continue;
      const auto isFree = [&](std::size_t slot) {
        return team.shirts[slot] == 0 || !wears(team.shirts[slot]);
      };
      std::size_t slot = GameTeam::mostPlayers;
      if (robot.number >= 1 && robot.number <= static_cast<int>(slot) &&
          isFree(static_cast<std::size_t>(robot.number - 1))) {
        slot = static_cast<std::size_t>(robot.number);
      }
      while (slot > 0 && !isFree(slot - 1)) --slot;
      if (slot == 0) continue;
      if (team.shirts[slot - 1] != 0) team.players[slot - 1] = {};
      team.shirts[slot - 1] = robot.number;
    }
  }
}

Result<void> validate(const RefereeRules& rules) {
  const char* wrong = nullptr;
  const auto check = [&](const auto& parameters) {
    for (const auto& parameter : parameters) {
      const double value = rules.*parameter.member;
      if (!(value >= parameter.least && value <= parameter.most)) wrong = parameter.key;
    }
  };
  check(refereeParameters);
  check(refereeCounts);
  if (!wrong) return {};
  return failure(ErrorCode::InvalidArgument, "This value of the rules is out of range.",
                 std::string("referee.") + wrong);
}

void swapSides(WorldState& world) {
  world.game->swapped = !world.game->swapped;
  for (RobotIdentity& robot : world.robots) {
    if (world.game->teamOf(robot.team) >= 0) robot.imuStartsAt180 = !robot.imuStartsAt180;
  }
}

bool isPlausible(const GameState& game, std::size_t robots) {
  const auto isTeam = [](int team) { return team >= GameState::noTeam && team <= 1; };
  const auto isTime = [](int ticks) { return ticks > -100'000'000 && ticks < 100'000'000; };
  const bool teams = isTeam(game.kickOff) && isTeam(game.restart.team) && isTeam(game.touch.team) &&
                     isTeam(game.dropIn.team) && isTeam(game.shooter) &&
                     (game.firstKickOff == 0 || game.firstKickOff == 1);
  const bool times =
      isTime(game.clock) && isTime(game.countdown.ticks) && isTime(game.stateTicks) &&
      isTime(game.hidden) && isTime(game.breakLeft) && isTime(game.dropIn.ticks) &&
      isTime(game.touch.ticks) && std::ranges::all_of(game.watches, [&](const RobotWatch& watch) {
        return isTime(watch.stillTicks) && isTime(watch.areaTicks) && isTime(watch.backTicks);
      });
  const bool counts = std::all_of(game.teams.begin(), game.teams.end(), [&](const GameTeam& team) {
    return team.score >= 0 && team.score < 1'000'000 && team.penaltyShots >= 0 &&
           team.penaltyShots < 1000 && team.penalties >= 0 && team.penalties < 100'000 &&
           team.number >= 0 && team.number < 256 &&
           std::ranges::all_of(team.byHalf, [](int n) { return n >= 0 && n < 1'000'000; }) &&
           std::ranges::all_of(team.shirts, [](int n) { return n >= 0 && n <= 1000; }) &&
           std::all_of(team.players.begin(), team.players.end(),
                       [&](const GamePlayer& p) { return isTime(p.ticksLeft); });
  });
  return teams && times && counts && game.watches.size() == robots && game.half >= 1 &&
         game.half <= 2 && game.teams[0].colour != game.teams[1].colour;
}

Result<void> callReferee(WorldState& world, const Snapshot& now, const RefereeCall& call,
                         Placements& placements, std::vector<Event>& events) {
  RefereeTable table(world, now, placements, events);
  TRY(checkCall(*world.game, *world.settings.referee, world.robots, call));
  world.game->obeyed = false;  // whoever calls has the game, until a GameController's next packet
  table.carryOut(call);
  return {};
}

void stepReferee(WorldState& world, const Snapshot& now, const BallSweep& sweep,
                 Placements& placements, std::vector<Event>& events) {
  RefereeTable(world, now, placements, events).tick(sweep);
}

int secondsOf(int ticks, double tickRate) {
  return static_cast<int>(std::ceil(static_cast<double>(ticks) / tickRate - 1e-9));
}

}  // namespace pitchboard::sim
