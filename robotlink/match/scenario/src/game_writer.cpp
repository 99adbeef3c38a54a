// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <nlohmann/json.hpp>

#include <robotlink/models/model_json.h>

#include "game_json.h"
#include "game_names.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;
using sim::GameStart;

template <class Enum>
const std::string& keyOfValue(const std::vector<std::string>& keys, Enum value) {
  return keys[static_cast<std::size_t>(value)];
}

std::string nameOf(RobotId id, const Scenario& scenario) {
  for (const ScenarioRobot& robot : scenario.robots) {
    if (robot.identity.id == id) return robot.identity.name();
  }
  return {};
}

void addPlace(const std::optional<Point>& place, Json& out) {
  if (!place) return;
  out["x"] = jsonNumber(place->x);
  out["y"] = jsonNumber(place->y);
}

Json restToJson(const GameStart::Rest& rest) {
  Json out = Json::object();
  addPlace(rest.place, out);
  out["time"] = jsonNumber(rest.time);
  return out;
}

Json takingToJson(const GameStart::Taking& taking, const Scenario& scenario) {
  Json out{{"kind", keyOfValue(setPlayKeys(), taking.kind)}};
  if (taking.team) out["team"] = info(*taking.team).name;
  if (taking.step) out["step"] = stepKeys[static_cast<std::size_t>(*taking.step)];
  addPlace(taking.place, out);
  if (const std::string kicker = nameOf(taking.kicker, scenario); !kicker.empty()) {
    out["kicker"] = kicker;
  }
  if (taking.passed) out["passed"] = true;
  if (taking.onlyTaker) out["only_taker"] = true;
  return out;
}

/// Writes one object with the values of all teams, unless all are empty.
template <class Getter>
void addTeams(const GameStart& game, Json& out, const char* key, Getter&& given) {
  Json all = Json::object();
  for (const auto& [colour, team] : game.teams) {
    if (Json one = given(team); !one.is_null()) all[info(colour).name] = std::move(one);
  }
  if (!all.empty()) out[key] = std::move(all);
}

Json countToJson(int count) {
  return count == 0 ? Json() : Json(count);
}

void addTeamsToJson(const GameStart& game, Json& out) {
  addTeams(game, out, "score", [](const auto& team) { return Json(team.score); });
  addTeams(game, out, "by_half", [](const auto& team) {
    if (!team.byHalf) return Json();
    const auto& goals = *team.byHalf;
    const bool extra = goals[2] != 0 || goals[3] != 0;
    return Json(std::vector<int>(goals.begin(), goals.begin() + (extra ? 4 : 2)));
  });
  addTeams(game, out, "timeouts", [](const auto& team) { return countToJson(team.timeouts); });
  addTeams(game, out, "removals", [](const auto& team) { return countToJson(team.removals); });
  Json shootOut = Json::object();
  if (game.shooter) shootOut["shooter"] = info(*game.shooter).name;
  addTeams(game, shootOut, "shots", [](const auto& team) { return countToJson(team.shots); });
  addTeams(game, shootOut, "scored", [](const auto& team) {
    Json shots;
    for (int shot = 0; shot < 16; ++shot) {
      if ((team.scored >> shot & 1) != 0) shots.push_back(shot + 1);
    }
    return shots;
  });
  if (!shootOut.empty()) out["shoot_out"] = std::move(shootOut);
}

}  // namespace

Json gameStartToJson(const GameStart& game, const Scenario& scenario) {
  Json out{{"state", keyOfValue(keysOf<PlayState>(), game.state)}};
  const auto time = [&out](const char* key, const std::optional<double>& seconds) {
    if (seconds) out[key] = jsonNumber(*seconds);
  };
  const auto flag = [&out](const char* key, bool is) {
    if (is) out[key] = true;
  };
  if (game.phase != GamePhase::Normal) {
    out["phase"] = keyOfValue(keysOf<GamePhase>(), game.phase);
  }
  if (game.phaseBefore != GamePhase::Normal) {
    out["phase_before"] = keyOfValue(keysOf<GamePhase>(), game.phaseBefore);
  }
  if (game.half != 1) out["half"] = game.half;
  time("clock", game.clock);
  if (game.clockUse) out["clock_use"] = clockUseKeys[static_cast<std::size_t>(*game.clockUse)];
  time("state_time", game.stateTime);
  time("countdown", game.countdown);
  if (game.countdownRuns) out["countdown_runs"] = *game.countdownRuns;
  time("hidden", game.hidden);
  time("break", game.breakLeft);
  if (game.left) out["left"] = info(*game.left).name;
  if (game.firstKickOff) out["first_kick_off"] = info(*game.firstKickOff).name;
  if (game.kickOff) {
    out["kick_off"] = game.kickOff->team ? Json(info(*game.kickOff->team).name) : Json();
  }
  addTeamsToJson(game, out);
  if (game.setPlay) out["set_play"] = takingToJson(*game.setPlay, scenario);
  if (game.dropIn) {
    out["drop_in"] = {{"team", info(game.dropIn->team).name},
                      {"ago", jsonNumber(game.dropIn->ago)}};
  }
  if (game.touch) {
    out["touch"] = {{"robot", nameOf(game.touch->robot, scenario)},
                    {"ago", jsonNumber(game.touch->ago)}};
  }
  if (game.ballStill) out["ball_still"] = restToJson(*game.ballStill);
  if (game.ballNear) out["ball_near"] = restToJson(*game.ballNear);
  if (game.ballAlone != 0.0) out["ball_alone"] = jsonNumber(game.ballAlone);
  flag("stopped", game.stopped);
  flag("over", game.over);
  return out;
}

void addGameOf(const GameStart& game, RobotId robot, Json& out) {
  const auto found = game.robots.find(robot);
  if (found == game.robots.end()) return;
  const GameStart::Robot& given = found->second;
  if (given.penalty != PenaltyKind::None) {
    Json& penalty = out["penalty"];
    penalty["kind"] = keyOfValue(penaltyKeys(), given.penalty);
    if (given.left) penalty["left"] = jsonNumber(*given.left);
    if (given.since != 0.0) penalty["since"] = jsonNumber(given.since);
    if (given.outside) penalty["outside"] = true;
    if (given.counts) penalty["counts"] = *given.counts;
  }
  for (const auto& [key, count] :
       {std::pair("warnings", given.warnings), std::pair("yellow", given.yellow),
        std::pair("red", given.red), std::pair("cautions", given.cautions)}) {
    if (count != 0) out["cards"][key] = count;
  }
  if (given.goalkeeper) out["goalkeeper"] = *given.goalkeeper;
}

}  // namespace pitchboard::link
