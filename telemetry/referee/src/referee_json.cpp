// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/referee/referee_json.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::ordered_json;

// Names that identify codes for programs; labelOf() has the words for people.
constexpr std::array<std::string_view, 10> secStates{
    "NORMAL",      "PENALTYSHOOT", "OVERTIME",  "TIMEOUT", "DIRECT_FREEKICK", "INDIRECT_FREEKICK",
    "PENALTYKICK", "CORNER_KICK",  "GOAL_KICK", "THROW_IN"};
constexpr std::array<std::string_view, 3> gameTypes{"ROUNDROBIN", "PLAYOFF", "DROPIN"};
constexpr std::array<std::string_view, 4> phases{"normal", "penalty shoot-out", "overtime",
                                                 "timeout"};
constexpr std::array<std::string_view, 6> setPlaysOfSpl{"none",   "goal kick", "pushing free kick",
                                                        "corner", "kick-in",   "penalty"};
constexpr std::array<std::string_view, 7> setPlaysOfHsl{
    "none", "direct free kick", "indirect free kick", "penalty", "throw-in", "goal kick", "corner"};

std::string_view pick(std::span<const std::string_view> names, int code,
                      std::string_view otherwise) {
  return code >= 0 && static_cast<std::size_t>(code) < names.size()
             ? names[static_cast<std::size_t>(code)]
             : otherwise;
}

void put(Json& json, const char* key, const std::optional<int>& value) {
  if (value) json[key] = *value;
}

std::string hex(const std::array<int, 4>& bytes) {
  char text[9];
  std::snprintf(text, sizeof text, "%02x%02x%02x%02x", bytes[0] & 0xff, bytes[1] & 0xff,
                bytes[2] & 0xff, bytes[3] & 0xff);
  return text;
}

Json playerJson(const RefereeState& state, const RefereePlayer& player) {
  Json json{{"n", player.number},
            {"penalty", player.penalty},
            {"secs", player.secondsLeft},
            {"penaltyName", penaltyName(state, player.penalty)}};
  put(json, "warnings", player.warnings);
  put(json, "yellow", player.yellow);
  put(json, "red", player.red);
  put(json, "cautions", player.cautions);
  put(json, "goalkeeper", player.goalkeeper);
  if (player.unreliable) json["unreliable"] = "bytes overwritten by the 2013 hack fields";
  return json;
}

Json teamJson(const RefereeState& state, const RefereeTeam& team) {
  Json json{{"number", team.number}, {"colour", team.colour}, {"score", team.score}};
  put(json, "goalColour", team.goalColour);
  put(json, "goalkeeperColor", team.goalkeeperColour);
  put(json, "goalkeeper", team.goalkeeper);
  put(json, "messageBudget", team.messageBudget);
  put(json, "penaltyShot", team.penaltyShot);
  put(json, "singleShots", team.singleShots);
  Json players = Json::array();
  for (const RefereePlayer& player : team.players()) players.push_back(playerJson(state, player));
  json["players"] = std::move(players);
  return json;
}

Json stateJson(const RefereeState& state) {
  Json json{{"header", std::string(state.magic.begin(), state.magic.end())},
            {"version", state.version},
            {"size", state.size}};
  put(json, "packetNumber", state.packetNumber);
  json["playersPerTeam"] = state.playersPerTeam;
  json["state"] = state.state;
  json["stateName"] = labelOf(playStateOf(state.state));
  json["firstHalf"] = state.firstHalf != 0;
  json["kickOffRaw"] = state.kickOffRaw;
  json["kickOffTeamNumber"] = state.kickOffTeam ? Json(*state.kickOffTeam) : Json(nullptr);
  if (state.secState) {
    json["secGameState"] = *state.secState;
    json["secGameStateName"] = pick(secStates, *state.secState, "UNKNOWN");
  }
  if (state.gameType) {
    json["gameType"] = *state.gameType;
    json["gameTypeName"] = pick(gameTypes, *state.gameType, "UNKNOWN");
  }
  if (state.secStateInfo) json["secGameStateInfoHex"] = hex(*state.secStateInfo);
  put(json, "gamePhase", state.gamePhase);
  if (state.gamePhase) json["gamePhaseName"] = pick(phases, *state.gamePhase, "unknown");
  put(json, "setPlay", state.setPlay);
  if (state.setPlay) {
    const bool isHsl = state.league == League::HumanoidSoccer;
    json["setPlayName"] = isHsl ? pick(setPlaysOfHsl, *state.setPlay, "unknown")
                                : pick(setPlaysOfSpl, *state.setPlay, "unknown");
  }
  put(json, "competitionType", state.competitionType);
  put(json, "competitionPhase", state.competitionPhase);
  put(json, "stopped", state.stopped);
  put(json, "dropInTeam", state.dropInTeam);
  put(json, "dropInTime", state.dropInTime);
  json["secsRemaining"] = state.secsRemaining;
  put(json, "secondaryTime", state.secondaryTime);
  json["teams"] = Json::array({teamJson(state, state.teams[0]), teamJson(state, state.teams[1])});
  if (state.extra2013) {
    const RefereeExtra2013& extra = *state.extra2013;
    char shots[5];
    std::snprintf(shots, sizeof shots, "%02x%02x", extra.penaltyShot[0] & 0xff,
                  extra.penaltyShot[1] & 0xff);
    json["v7hack_bytes107_115"] = {{"timeOut", extra.timeOut},
                                   {"penaltyShot", shots},
                                   {"penaltyTries", extra.penaltyTries},
                                   {"subTime", extra.subTime}};
  }
  return json;
}

Json number(float value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json replyJson(const RobotReply& reply) {
  Json json{{"header", "RGrt"},
            {"version", reply.version},
            {"size", reply.size},
            {"team", reply.team},
            {"player", reply.player}};
  put(json, "message", reply.message);
  put(json, "fallen", reply.fallen);
  if (reply.pose) {
    json["pose"] = {number((*reply.pose)[0]), number((*reply.pose)[1]), number((*reply.pose)[2])};
  }
  if (reply.ballAge) json["ballAge"] = number(*reply.ballAge);
  if (reply.ball) json["ball"] = {number((*reply.ball)[0]), number((*reply.ball)[1])};
  return json;
}

}  // namespace

Json refereeJson(const RefereePacket& packet) {
  if (const auto* state = std::get_if<RefereeState>(&packet)) return stateJson(*state);
  if (const auto* reply = std::get_if<RobotReply>(&packet)) return replyJson(*reply);
  const auto* forwarded = std::get_if<ForwardedReply>(&packet);
  if (!forwarded) return {{"header", "RGTr"}};
  Json json = replyJson(forwarded->reply);
  json["robot"] = Address{forwarded->robot}.text();
  return json;
}

}  // namespace pitchboard::telemetry
