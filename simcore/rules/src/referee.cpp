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

/// Returns the teams of the settings, else those of the colours on the field, else blue and red.
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

Result<void> checkTeam(const Game& game, TeamColor team) {
  if (game.teamOf(team) != Game::noTeam) return {};
  const auto name = [&game](std::size_t index) {
    return std::string(info(game.teams[index].colour).name);
  };
  return failure(ErrorCode::Conflict,
                 "This match has a referee and is between " + name(0) + " and " + name(1) +
                     ". Choose one of these teams, or play without a referee.");
}

Result<Game> newGame(WorldState& world, const Snapshot& now) {
  const RefereeRules& rules = *world.settings.referee;
  const double rate = world.settings.tickRate;
  Game game;
  auto teams = teamsOf(world);
  if (!teams) return tl::unexpected(teams.error());
  game.teams = *teams;
  game.clock = static_cast<int>(std::lround(rules.halfTime * rate));
  game.breakLeft = static_cast<int>(std::lround(rules.beforeMatch * rate));
  game.league = leagueOf(rules.style);
  game.tickRate = rate;
  world.refereeMemory = {};
  world.refereeMemory.watches.resize(world.robots.size());
  giveSlots(world.robots, game);
  // The first robot of a team says in which direction its team attacks.
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

void giveSlots(std::span<const RobotIdentity> robots, Game& game) {
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
      std::size_t slot = GameTeam::maxPlayers;
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

bool isPlausible(const Game& game, const RefereeMemory& memory, std::size_t robots) {
  const auto isTeam = [](int team) { return team >= Game::noTeam && team <= 1; };
  const auto isTime = [](int ticks) { return ticks > -100'000'000 && ticks < 100'000'000; };
  const bool teams = isTeam(game.kickOff) && isTeam(game.restart.team) &&
                     isTeam(memory.touch.team) && isTeam(game.dropIn.team) &&
                     isTeam(game.shooter) && (game.firstKickOff == 0 || game.firstKickOff == 1);
  const bool times =
      isTime(game.clock) && isTime(game.countdown.ticks) && isTime(game.stateTicks) &&
      isTime(game.hidden) && isTime(game.breakLeft) && isTime(game.dropIn.ticks) &&
      isTime(memory.touch.ticks) &&
      std::ranges::all_of(memory.watches, [&](const RobotWatch& watch) {
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
  return teams && times && counts && memory.watches.size() == robots && game.half >= 1 &&
         game.half <= 2 && game.teams[0].colour != game.teams[1].colour;
}

void reportObeyed(const Game& before, bool joins, const WorldState& world,
                  std::vector<Event>& events) {
  const Game& now = *world.game;
  const auto report = [&](EventKind kind, int value = 0, RobotId robot = {}) {
    events.push_back({kind, world.tick, robot, value, 0});
  };
  if (now.phase != before.phase) report(EventKind::PhaseChanged, static_cast<int>(now.phase));
  // The packets of a shoot-out belong to neither half.
  if (now.half != before.half && now.phase != GamePhase::ShootOut) {
    report(EventKind::HalfBegan, now.half);
  }
  for (std::size_t i = 0; i < now.teams.size(); ++i) {
    const int more = now.teams[i].score - before.teams[i].score;
    if (more == 0) continue;
    report(more > 0 && !joins ? EventKind::Goal : EventKind::ScoreCorrected,
           now.leftTeam() == i ? 0 : 1);
  }
  if (now.state != before.state) report(EventKind::PlayStateChanged, static_cast<int>(now.state));
  if (now.stopped != before.stopped) {
    report(now.stopped ? EventKind::PlayStopped : EventKind::PlayGoesOn);
  }
  if (now.setPlay() != before.setPlay() || now.setPlayTeam() != before.setPlayTeam()) {
    if (now.setPlay() != SetPlay::None) {
      report(EventKind::SetPlayBegan, static_cast<int>(now.setPlay()));
    } else {
      report(EventKind::SetPlayOver);
    }
  }
  for (const RobotIdentity& robot : world.robots) {
    const GamePlayer* was = before.player(robot.team, robot.number);
    const GamePlayer* is = now.player(robot.team, robot.number);
    if (!was || !is || was->penalty == is->penalty) continue;
    if (is->penalty != PenaltyKind::None) {
      report(EventKind::Penalised, static_cast<int>(is->penalty), robot.id);
    } else {
      report(EventKind::PenaltyOver, 0, robot.id);
    }
  }
}

Result<void> callReferee(WorldState& world, const Snapshot& now, const RefereeCall& call,
                         Placements& placements, std::vector<Event>& events) {
  RefereeTable table(world, now, placements, events);
  TRY(checkCall(*world.game, *world.settings.referee, world.robots, call));
  world.refereeMemory.obeyed =
      false;  // whoever calls has the game, until a GameController's next packet
  table.carryOut(call);
  return {};
}

void stepReferee(WorldState& world, const Snapshot& now, const BallSweep& sweep,
                 Placements& placements, std::vector<Event>& events) {
  RefereeTable(world, now, placements, events).tick(sweep);
}

}  // namespace pitchboard::sim
