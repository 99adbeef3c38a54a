// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/rules/referee.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <simcore/world/referee_parameters.h>

#include "referee_table.h"

namespace pitchboard::sim {

GameState newGame(const WorldState& world, const Snapshot& now) {
  const RefereeRules& rules = *world.settings.referee;
  const double rate = world.settings.tickRate;
  GameState game;
  game.teams[0].number = 1;
  game.teams[0].colour = TeamColor::Blue;
  game.teams[1].number = 2;
  game.teams[1].colour = TeamColor::Red;
  game.clock = static_cast<int>(std::lround(rules.halfTime * rate));
  game.breakLeft = static_cast<int>(std::lround(rules.beforeMatch * rate));
  game.watches.resize(world.robots.size());
  // Who attacks where is what their robots were told.
  for (const RobotIdentity& robot : world.robots) {
    if (robot.team == TeamColor::Blue) {
      game.swapped = robot.imuStartsAt180;
      break;
    }
  }
  for (int t = 0; t < 2; ++t) {
    GameTeam& team = game.teams[static_cast<std::size_t>(t)];
    const double goal =
        (game.attacksRight(static_cast<std::size_t>(t)) ? -1.0 : 1.0) * world.settings.field.halfLength();
    double nearest = std::numeric_limits<double>::max();
    int keeper = 0;
    for (std::size_t i = 0; i < world.robots.size(); ++i) {
      const RobotIdentity& robot = world.robots[i];
      if (robot.team != team.colour || robot.number < 1 ||
          robot.number > static_cast<int>(GameTeam::mostPlayers)) {
        continue;
      }
      const double d = squared(now.robots[i].pose.position, {goal, 0.0});
      if (d >= nearest) continue;
      nearest = d;
      keeper = robot.number;
    }
    if (keeper > 0) team.players[static_cast<std::size_t>(keeper - 1)].goalkeeper = true;
  }
  return game;
}

Result<void> validate(const RefereeRules& rules) {
  for (const auto& parameter : refereeParameters) {
    const double value = rules.*parameter.member;
    if (std::isfinite(value) && value >= parameter.least && value <= parameter.most) continue;
    return failure(ErrorCode::InvalidArgument,
                   "This value of the referee's rules is out of its range.",
                   std::string("referee.") + parameter.key);
  }
  return {};
}

bool isPlausible(const GameState& game, std::size_t robots) {
  const auto isTeam = [](int team) { return team >= GameState::nobody && team <= 1; };
  const auto isTime = [](int ticks) { return ticks > -100'000'000 && ticks < 100'000'000; };
  const bool teams = isTeam(game.kickOff) && isTeam(game.setPlayTeam) &&
                     isTeam(game.restartTeam) && isTeam(game.lastTouchTeam) &&
                     isTeam(game.dropInTeam) && isTeam(game.shooter) &&
                     (game.firstKickOff == 0 || game.firstKickOff == 1);
  const bool times = isTime(game.clock) && isTime(game.secondary) && isTime(game.stateTicks) &&
                     isTime(game.hidden) && isTime(game.breakLeft) && isTime(game.dropInTicks);
  const bool counts = std::all_of(game.teams.begin(), game.teams.end(), [&](const GameTeam& team) {
    return team.score >= 0 && team.score < 1'000'000 && team.penaltyShots >= 0 &&
           team.penaltyShots < 1000 && team.penalties >= 0 && team.penalties < 100'000 &&
           team.number >= 0 && team.number < 256 &&
           std::all_of(team.players.begin(), team.players.end(),
                       [&](const GamePlayer& p) { return isTime(p.ticksLeft); });
  });
  return teams && times && counts && game.watches.size() == robots && game.half >= 1 &&
         game.half <= 2 && game.teams[0].colour != game.teams[1].colour;
}

Result<void> callReferee(WorldState& world, const Snapshot& now, const RefereeCall& call,
                         Placements& placements, std::vector<Event>& events) {
  return RefereeTable(world, now, placements, events).call(call);
}

void stepReferee(WorldState& world, const Snapshot& now, const BallWay& way,
                 Placements& placements, std::vector<Event>& events) {
  RefereeTable(world, now, placements, events).tick(way);
}

int secondsOf(int ticks, double tickRate) {
  return static_cast<int>(std::ceil(static_cast<double>(ticks) / tickRate - 1e-9));
}

}  // namespace pitchboard::sim
