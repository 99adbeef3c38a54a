// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_json.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include <robotlink/live/live_teams.h>
#include <simcore/world/action_codes.h>

#include "json_text.h"

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

void addWhole(std::string& out, std::int64_t value) {
  std::array<char, 24> text;
  out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

std::string stateLine(const RefereeState& state) {
  const Game game = gameOf(state);
  std::string out = "referee v" + std::to_string(state.version) + "  " +
                    std::string(labelOf(game.state)) + "  " +
                    (game.half == 1 ? "1st half" : "2nd half") + "  ";
  const int time = game.secondsLeft();
  char clock[32];
  std::snprintf(clock, sizeof clock, "%s%02d:%02d", time < 0 ? "-" : "", std::abs(time) / 60,
                std::abs(time) % 60);
  out += clock;
  for (const GameTeam& team : game.teams) {
    out += "  team " + std::to_string(team.number) + " (" + std::string(info(team.colour).name) +
           "): " + std::to_string(team.score);
    for (const int shirt : team.onField()) {
      const GamePlayer& player = *team.player(shirt);
      if (player.penalty == PenaltyKind::None) continue;
      out += ", player " + std::to_string(shirt) + " " + std::string(labelOf(player.penalty)) +
             " " + std::to_string(player.ticksLeft) + " s";
    }
  }
  return state.trueData() ? out + "  (true data)" : out;
}

std::string replyLine(const RobotReply& reply) {
  return "robot's reply v" + std::to_string(reply.version) + "  team " +
         std::to_string(reply.team) + " player " + std::to_string(reply.player);
}

/// The title of its setup; empty without setups.
std::string teamOf(const RobotKey& robot, const link::LiveOptions& options) {
  const TeamSetup* team = robot.number > 0 ? setupAt(robot.team, options.team.teams) : nullptr;
  return team != nullptr ? team->title() : std::string();
}

bool haveOneName(const TextDecoder& decoder, const DecodedText& message, std::size_t a,
                 std::size_t b) {
  const auto& fields = decoder.profile().fields;
  if (a < fields.size() && b < fields.size()) return fields[a].name == fields[b].name;
  return decoder.name(message, a) == decoder.name(message, b);
}

/// Of values with one name, the last one is shown where the first one stands.
std::optional<std::size_t> shownAt(const TextDecoder& decoder, const DecodedText& message,
                                   std::size_t index) {
  std::size_t last = index;
  for (std::size_t i = 0; i < message.count; ++i) {
    if (i == index || !haveOneName(decoder, message, i, index)) continue;
    if (i < index) return std::nullopt;
    last = i;
  }
  return last;
}

void addValue(std::string& out, const TextDecoder& decoder, const DecodedText& message,
              std::size_t index) {
  const auto& fields = decoder.profile().fields;
  const bool isExtra = index >= fields.size();
  const double value = message.values[index];
  if (!message.has(index)) {
    // An extra field may be text; a named one is a number or nothing.
    const bool isText = isExtra || fields[index].type == FieldType::Text;
    if (isText && !message.texts[index].empty())
      addJsonText(out, message.texts[index]);
    else
      out += "null";
  } else if (value == std::floor(value) && std::abs(value) < 9e15 &&
             (isExtra || fields[index].type != FieldType::Float)) {
    addWhole(out, static_cast<std::int64_t>(value));
  } else {
    addJsonNumber(out, value);
  }
}

/// "robot": 1, "values": {"X": 258, ...}, "errors": [...]; "text" is added when there are errors.
void addTelemetryMembers(std::string& out, const link::LiveDatagram& datagram,
                         const std::string& team, const std::string& robot) {
  const TextDecoder& decoder = *datagram.decoder;
  const DecodedText& message = *datagram.decoded;
  const auto addText = [&out](std::string_view key, std::string_view text) {
    addJsonKey(out, key);
    addJsonText(out, text);
  };
  addJsonKey(out, "robot");
  if (robot.empty())
    out += "null";
  else
    addWhole(out, datagram.robot.number);
  if (!team.empty()) addText("team", team);
  if (!robot.empty()) addText("name", robot);
  addJsonKey(out, "accepted");
  out += message.accepted() ? "true" : "false";
  addJsonKey(out, "values");
  out += '{';
  const auto& fields = decoder.profile().fields;
  for (std::size_t i = 0; i < message.count; ++i) {
    const auto shown = shownAt(decoder, message, i);
    if (!shown) continue;
    addJsonKey(out, i < fields.size() ? fields[i].name : decoder.name(message, i));
    addValue(out, decoder, message, *shown);
  }
  out += '}';
  if (const auto action = decoder.value(message, FieldMeaning::Action)) {
    addText("action", actionLabel(static_cast<int>(*action)));
  }
  addJsonKey(out, "errors");
  out += dump(errorList(message.errors));
  if (!message.errors.empty()) addText("text", printable(datagram.view.payload));
}

void addTelemetryLine(std::string& out, const link::LiveDatagram& datagram, const std::string& team,
                      std::string_view robot) {
  const TextDecoder& decoder = *datagram.decoder;
  const DecodedText& message = *datagram.decoded;
  if (message.accepted()) {
    if (!team.empty()) out.append(team).append("  ");
    out += robot;
    const auto& fields = decoder.profile().fields;
    for (std::size_t i = 0; i < message.count; ++i) {
      if (message.texts[i].empty()) continue;
      out += "  ";
      out += i < fields.size() ? fields[i].name : decoder.name(message, i);
      out += ' ';
      addPrintable(out, message.texts[i], 40);
    }
    if (message.errors.empty()) return;
    out += "  ";
  }
  out += "[";
  bool first = true;
  for (std::size_t i = 0; i < textErrorCount; ++i) {
    const auto error = static_cast<TextError>(i);
    if (!message.errors.has(error)) continue;
    out += (first ? "" : ", ") + std::string(errorText(error));
    first = false;
  }
  out += "] ";
  addPrintable(out, datagram.view.payload, 120);
}

Json variablesJson(const link::LiveDatagram& datagram, const std::string& robot) {
  if (!*datagram.variables) {
    return {{"robot", nullptr},
            {"error", datagram.variables->error().text()},
            {"text", printable(datagram.view.payload)}};
  }
  const Pb2Message& message = **datagram.variables;
  Json json{{"robot", message.robot},
            {"name", robot},
            {"sequence", message.sequence},
            {"milliseconds", message.milliseconds}};
  Json values = Json::object();
  for (const Pb2Value& value : message.values) {
    const std::string name(value.name);
    if (value.whole) {
      values[name] = static_cast<std::int64_t>(value.value);
    } else {
      values[name] = std::isfinite(value.value) ? Json(value.value) : Json(nullptr);
    }
  }
  json["values"] = std::move(values);
  if (message.status.refresh_ms) json["refresh"] = *message.status.refresh_ms;
  if (message.status.waiting) json["waiting"] = *message.status.waiting;
  if (message.status.blackboard) json["blackboard"] = *message.status.blackboard;
  json["late"] = datagram.variablesVerdict == link::SentBoards::Verdict::Late;
  json["duplicate"] = datagram.variablesVerdict == link::SentBoards::Verdict::Duplicate;
  return json;
}

std::string variablesLine(const link::LiveDatagram& datagram, const std::string& robot) {
  if (!*datagram.variables) {
    return "[" + datagram.variables->error().text() + "] " + printable(datagram.view.payload, 120);
  }
  const Pb2Message& message = **datagram.variables;
  std::string out = robot + "  variables " + std::to_string(message.sequence);
  for (const Pb2Value& value : message.values) {
    out += "  " + std::string(value.name) + " " +
           std::string(value.whole ? Pb2Number(static_cast<std::int64_t>(value.value)).text()
                                   : Pb2Number(static_cast<float>(value.value)).text());
  }
  return out;
}

/// The content of a datagram that is not telemetry.
Json messageJson(const link::LiveDatagram& datagram, const std::string& robot) {
  if (datagram.referee) {
    if (*datagram.referee) return refereeJson(**datagram.referee);
    return {{"error", datagram.referee->error().message},
            {"bytes", datagram.view.payload.size()},
            {"text", printable(datagram.view.payload)}};
  }
  if (datagram.variables) return variablesJson(datagram, robot);
  Json json{{"robot", robot.empty() ? Json(nullptr) : Json(datagram.robot.number)}};
  if (!robot.empty()) json["name"] = robot;
  if (datagram.drawingProblem) json["error"] = *datagram.drawingProblem;
  json["text"] = datagram.view.payload;
  return json;
}

std::string refereeLine(const RefereePacket& packet) {
  if (const auto* state = std::get_if<RefereeState>(&packet)) return stateLine(*state);
  if (const auto* reply = std::get_if<RobotReply>(&packet)) return replyLine(*reply);
  const auto* forwarded = std::get_if<ForwardedReply>(&packet);
  return forwarded ? replyLine(forwarded->reply) + " at " + Address{forwarded->robot}.text()
                   : "request for true data";
}

}  // namespace

const char* typeOf(const link::LiveDatagram& datagram) {
  if (datagram.referee) return "referee";
  if (datagram.variables) return "variables";
  return datagram.decoded ? "telemetry" : "drawing";
}

bool isGood(const link::LiveDatagram& datagram) {
  if (datagram.referee) return datagram.referee->has_value();
  if (datagram.variables) return datagram.variables->has_value();
  return datagram.decoded ? datagram.decoded->accepted() : !datagram.drawingProblem;
}

std::string nameOf(const RobotKey& robot, const link::Teams& teams) {
  return robot.number > 0 ? link::robotName(robot, teams) : std::string();
}

void addMessageJson(std::string& out, Json head, const link::LiveDatagram& datagram,
                    const link::LiveOptions& options) {
  const std::string robot = nameOf(datagram.robot, datagram.teams);
  if (datagram.decoded && !datagram.referee && !datagram.variables) {
    out += dump(head);
    out.pop_back();
    addTelemetryMembers(out, datagram, teamOf(datagram.robot, options), robot);
    out += '}';
    return;
  }
  head.update(messageJson(datagram, robot));
  out += dump(head);
}

void addMessageLine(std::string& out, const link::LiveDatagram& datagram,
                    const link::LiveOptions& options) {
  if (datagram.referee) {
    out += *datagram.referee ? refereeLine(**datagram.referee)
                             : "[" + datagram.referee->error().message + "]";
    return;
  }
  const std::string robot = nameOf(datagram.robot, datagram.teams);
  if (datagram.variables) {
    out += variablesLine(datagram, robot);
  } else if (datagram.decoded) {
    addTelemetryLine(out, datagram, teamOf(datagram.robot, options), robot);
  } else if (datagram.drawingProblem) {
    out += "[drawing: " + *datagram.drawingProblem + "]";
  } else {
    out += robot + "  drawing, " + std::to_string(datagram.view.payload.size()) + " bytes";
  }
}

Json healthJson(const RobotStatus& robot, const std::string& name, WallTime now) {
  const auto counted = [&robot](std::uint64_t count) {
    return robot.loss ? Json(count) : Json(nullptr);
  };
  return {{"type", "health"},
          {"robot", robot.key.number},
          {"name", name},
          {"received", robot.messages},
          {"lost", counted(robot.lost)},
          {"duplicates", robot.duplicates},
          {"late", counted(robot.late)},
          {"loss", robot.loss ? Json(*robot.loss) : Json(nullptr)},
          {"rate", robot.rate},
          {"jitter", robot.jitter},
          {"age", secondsOf(robot.age)},
          {"timedOut", robot.timedOut},
          {"recoveries", robot.recoveries},
          {"offline", secondsOf(robot.offline)},
          {"errors", robot.errorCount},
          {"bytes", robot.bytes},
          {"sender", robot.sender.text()},
          {"slot", robot.key.sender},
          {"conflict", robot.conflict},
          {"time", unixSeconds(now)}};
}

std::string healthLine(const RobotStatus& robot, const std::string& name) {
  std::string out = name;
  if (robot.key.sender > 0) out += " at " + robot.sender.text();
  out += ": " + std::to_string(robot.messages) + " received";
  if (robot.loss) {
    char part[32];
    std::snprintf(part, sizeof part, " (%.1f %%)", *robot.loss * 100.0);
    out += ", " + std::to_string(robot.lost) + " lost" + part;
  }
  out += ", " + std::to_string(robot.duplicates) + " duplicates";
  if (robot.loss) out += ", " + std::to_string(robot.late) + " late";
  return out;
}

Json healthJson(const link::SentStatus& sent, WallTime now) {
  const LinkHealth& link = sent.link;
  const auto optionalNumber = [](const std::optional<std::int64_t>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  return {{"type", "variablesHealth"},
          {"robot", sent.robot.number},
          {"name", sent.name},
          {"variables", sent.variables},
          {"catalog", sent.catalog},
          {"unknown", sent.unknown},
          {"received", link.messages},
          {"lost", link.lost},
          {"duplicates", link.duplicates},
          {"late", link.late},
          {"loss", link.loss.value_or(0.0)},
          {"rate", link.rate},
          {"jitter", link.jitter},
          {"clockOffset", sent.clockOffset},
          {"age", secondsOf(link.age)},
          {"timedOut", link.timedOut},
          {"restarts", sent.restarts},
          {"refresh", optionalNumber(sent.refresh_ms)},
          {"waiting", optionalNumber(sent.waiting)},
          {"blackboard", sent.blackboard},
          {"bytes", link.bytes},
          {"sender", link.sender.text()},
          {"time", unixSeconds(now)}};
}

std::string healthLine(const link::SentStatus& sent) {
  const LinkHealth& link = sent.link;
  char text[160];
  std::snprintf(text, sizeof text,
                ": %zu from %s, %llu received, %llu lost (%.1f %%), %llu duplicates, %llu late, "
                "jitter %.1f ms",
                sent.variables, link.sender.address.text().c_str(),
                static_cast<unsigned long long>(link.messages),
                static_cast<unsigned long long>(link.lost), link.loss.value_or(0.0) * 100.0,
                static_cast<unsigned long long>(link.duplicates),
                static_cast<unsigned long long>(link.late), link.jitter * 1000.0);
  std::string out = sent.name + " variables" + text;
  if (!sent.unknown.empty()) {
    out += ", " + std::to_string(sent.unknown.size()) + " unknown (--catalog FILE names them)";
  }
  return out;
}

Json topicJson(const link::LiveTopicMessage& received) {
  const RecordedMessage& message = received.message;
  Json values = Json::object();
  std::size_t text = 0;
  for (std::size_t i = 0; i < message.values.size(); ++i) {
    const RecordedField& field = message.shape->fields[i];
    Json& value = values[field.path];
    if (field.kind == RecordedKind::Text) {
      value = message.texts[text++];
    } else if (std::isfinite(message.values[i])) {
      value = message.values[i];
    }
  }
  return {{"type", "topic"},
          {"time", unixSeconds(received.arrival)},
          {"source", received.source.address.text()},
          {"topic", received.topic.name},
          {"messageType", received.topic.type},
          {"logTime", message.logTime},
          {"stamp", message.stamp ? Json(*message.stamp) : Json(nullptr)},
          {"values", std::move(values)}};
}

std::string topicLine(const link::LiveTopicMessage& received) {
  constexpr std::size_t mostValues = 12;
  const RecordedMessage& message = received.message;
  constexpr std::size_t longestName = 200;
  std::string line;
  addPrintable(line, received.topic.name, longestName);
  std::size_t text = 0;
  for (std::size_t i = 0; i < message.values.size() && i < mostValues; ++i) {
    const RecordedField& field = message.shape->fields[i];
    line += "  ";
    addPrintable(line, field.path, longestName);
    line += ' ';
    if (field.kind == RecordedKind::Text) {
      addPrintable(line, message.texts[text++], 40);
    } else {
      char number[32];
      std::snprintf(number, sizeof number, "%.9g", message.values[i]);
      line += number;
    }
  }
  if (message.values.size() > mostValues) line += "  ...";
  return line;
}

Json healthJson(const link::TopicSourceStatus& source, WallTime now) {
  const FoxgloveClientStatus& client = source.client;
  static constexpr const char* states[] = {"connecting", "connected", "waiting"};
  return {{"type", "topicsHealth"},
          {"source", source.source.address.text()},
          {"state", states[static_cast<std::size_t>(client.state)]},
          {"server", client.server},
          {"subprotocol", client.subprotocol},
          {"problem", client.problem},
          {"channels", source.channels},
          {"decoded", source.decoded},
          {"skipped", source.skipped},
          {"unread", source.unread},
          {"received", client.messages},
          {"dropped", client.dropped},
          {"malformed", client.malformed + source.wrong},
          {"connections", client.connections},
          {"rate", source.rate},
          {"delay", source.delay},
          {"jitter", source.jitter},
          {"clockOffset", source.clockOffset},
          {"bytes", client.bytes},
          {"time", unixSeconds(now)}};
}

std::string healthLine(const link::TopicSourceStatus& source) {
  const FoxgloveClientStatus& client = source.client;
  std::string line = source.source.address.text() + ": ";
  line +=
      client.state == FoxgloveState::Connected
          ? "connected to " + (client.server.empty() ? "a server without a name" : client.server)
          : "not connected";
  line += ", " + std::to_string(source.decoded) + " of " + std::to_string(source.channels) +
          " topics, " + std::to_string(client.messages) + " received, " +
          std::to_string(client.dropped) + " dropped, " +
          std::to_string(client.malformed + source.wrong) + " bad";
  if (!client.malformedReason.empty()) line += " (" + client.malformedReason + ")";
  char part[80];
  std::snprintf(part, sizeof part, ", delay %.1f ms above the shortest, jitter %.1f ms",
                source.delay * 1000.0, source.jitter * 1000.0);
  if (client.messages > 0) line += part;
  if (source.skipped > 0) {
    line += "; images and point clouds are skipped: " + std::to_string(source.skipped);
  }
  return line;
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double unixSeconds(WallTime time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

}  // namespace pitchboard::cli
