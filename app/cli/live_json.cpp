// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_json.h"

#include <telemetry/action_words.h>

#include <cmath>
#include <cstdio>

namespace pitchboard::cli {
namespace {

using namespace telemetry;

Json errorList(const TextErrors& errors) {
  Json list = Json::array();
  for (std::size_t i = 0; i < textErrorCount; ++i) {
    const auto error = static_cast<TextError>(i);
    if (errors.has(error)) list.push_back(errorName(error));
  }
  return list;
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
  json["stateName"] = stateName(state.state);
  json["firstHalf"] = state.firstHalf != 0;
  json["kickOffRaw"] = state.kickOffRaw;
  json["kickOffTeamNumber"] = state.kickOffTeam ? Json(*state.kickOffTeam) : Json(nullptr);
  if (state.secState) {
    json["secGameState"] = *state.secState;
    json["secGameStateName"] = secStateName(*state.secState);
  }
  if (state.gameType) {
    json["gameType"] = *state.gameType;
    json["gameTypeName"] = gameTypeName(*state.gameType);
  }
  if (state.secStateInfo) json["secGameStateInfoHex"] = hex(*state.secStateInfo);
  put(json, "gamePhase", state.gamePhase);
  if (state.gamePhase) json["gamePhaseName"] = gamePhaseWords(*state.gamePhase);
  put(json, "setPlay", state.setPlay);
  if (state.setPlay) json["setPlayName"] = setPlayWords(state.league, *state.setPlay);
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

Json number(float value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

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

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

std::string stateLine(const RefereeState& state) {
  std::string out = "referee v" + std::to_string(state.version) + "  " +
                    std::string(stateName(state.state)) + "  " +
                    (state.firstHalf != 0 ? "1st half" : "2nd half") + "  ";
  const int time = state.secsRemaining;
  char clock[32];
  std::snprintf(clock, sizeof clock, "%s%02d:%02d", time < 0 ? "-" : "", std::abs(time) / 60,
                std::abs(time) % 60);
  out += clock;
  for (const RefereeTeam& team : state.teams) {
    out += "  team " + std::to_string(team.number) + " (" + std::string(colourWords(team.colour)) +
           "): " + std::to_string(team.score);
    for (const RefereePlayer& player : team.players()) {
      if (player.penalty == 0 || isSubstitute(state, player)) continue;
      out += ", player " + std::to_string(player.number) + " " +
             std::string(penaltyWords(state, player.penalty)) + " " +
             std::to_string(player.secondsLeft) + " s";
    }
  }
  return state.trueData() ? out + "  (true data)" : out;
}

std::string replyLine(const RobotReply& reply) {
  return "robot's reply v" + std::to_string(reply.version) + "  team " +
         std::to_string(reply.team) + " player " + std::to_string(reply.player);
}

}  // namespace

Json telemetryJson(const TextDecoder& decoder, const DecodedText& message,
                   std::string_view datagram) {
  Json json;
  json["robot"] = message.robot > 0 ? Json(message.robot) : Json(nullptr);
  json["accepted"] = message.accepted();
  Json values = Json::object();
  const auto& fields = decoder.profile().fields;
  for (std::size_t i = 0; i < message.count; ++i) {
    const std::string name = decoder.name(i);
    if (!message.has(i)) {
      // An extra field may be a word; a named one is a number or nothing.
      values[name] = i < fields.size() ? Json(nullptr) : Json(std::string(message.words[i]));
    } else if (message.values[i] == std::floor(message.values[i]) &&
               std::abs(message.values[i]) < 9e15 &&
               (i >= fields.size() || fields[i].type != FieldType::Float)) {
      values[name] = static_cast<std::int64_t>(message.values[i]);
    } else {
      values[name] = message.values[i];
    }
  }
  json["values"] = std::move(values);
  if (const auto action = decoder.value(message, FieldMeaning::Action)) {
    json["action"] = actionWords(static_cast<int>(*action));
  }
  json["errors"] = errorList(message.errors);
  if (!message.errors.empty()) json["text"] = printable(datagram);
  return json;
}

std::string telemetryLine(const TextDecoder& decoder, const DecodedText& message,
                          std::string_view datagram) {
  std::string out;
  if (message.accepted()) {
    out = "robot " + std::to_string(message.robot);
    for (std::size_t i = 0; i < message.count; ++i) {
      out += "  " + decoder.name(i) + " " + printable(message.words[i], 40);
    }
    if (message.errors.empty()) return out;
    out += "  ";
  }
  out += "[";
  bool first = true;
  for (std::size_t i = 0; i < textErrorCount; ++i) {
    const auto error = static_cast<TextError>(i);
    if (!message.errors.has(error)) continue;
    out += (first ? "" : ", ") + std::string(errorWords(error));
    first = false;
  }
  return out + "] " + printable(datagram, 120);
}

Json refereeJson(const RefereePacket& packet) {
  return std::visit(
      Overloaded{[](const RefereeState& state) { return stateJson(state); },
                 [](const RobotReply& reply) { return replyJson(reply); },
                 [](const ForwardedReply& forwarded) {
                   Json json = replyJson(forwarded.reply);
                   json["robot"] = Address{forwarded.robot}.text();
                   return json;
                 },
                 [](const TrueDataRequest&) { return Json{{"header", "RGTr"}}; }},
      packet);
}

std::string refereeLine(const RefereePacket& packet) {
  return std::visit(
      Overloaded{[](const RefereeState& state) { return stateLine(state); },
                 [](const RobotReply& reply) { return replyLine(reply); },
                 [](const ForwardedReply& forwarded) {
                   return replyLine(forwarded.reply) + " at " + Address{forwarded.robot}.text();
                 },
                 [](const TrueDataRequest&) { return std::string("request for true data"); }},
      packet);
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double unixSeconds(WallTime time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

}  // namespace pitchboard::cli
