// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_books.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include <robotlink/live/live_teams.h>
#include <telemetry/wire/base64.h>

#include "live_frame.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;
using telemetry::Duration;
using telemetry::RefereeState;
using telemetry::WallTime;

const Json* member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

template <class T>
T whole(const Json& object, const char* key, T fallback = {}) {
  const Json* value = member(object, key);
  if (value == nullptr || !value->is_number_integer()) return fallback;
  if (value->is_number_unsigned()) {
    const auto number = value->get<std::uint64_t>();
    return std::in_range<T>(number) ? static_cast<T>(number) : fallback;
  }
  const auto number = value->get<std::int64_t>();
  return std::in_range<T>(number) ? static_cast<T>(number) : fallback;
}

double number(const Json& object, const char* key, double fallback) {
  const Json* value = member(object, key);
  return value != nullptr && value->is_number() ? value->get<double>() : fallback;
}

std::string text(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

/// With the profile itself: a setup names only its file.
Json teamJson(const telemetry::TeamSetup& team) {
  Json json{{"name", team.name},
            {"number", team.number},
            {"firstPort", team.firstPort},
            {"lastPort", team.lastPort},
            {"senders", team.senders},
            {"profileName", team.profileName},
            {"profile", telemetry::profileText(team.profile)},
            {"attacksLeft", team.attacksLeft}};
  if (team.colour) json["colour"] = info(*team.colour).name;
  for (const auto& [number, name] : team.robots) json["robots"][std::to_string(number)] = name;
  return json;
}

telemetry::TeamSetup teamFrom(const Json& json) {
  telemetry::TeamSetup team;
  team.name = text(json, "name");
  team.number = whole<int>(json, "number");
  team.firstPort = whole<int>(json, "firstPort");
  team.lastPort = whole<int>(json, "lastPort");
  team.profileName = text(json, "profileName");
  if (auto profile = telemetry::parseProfile(text(json, "profile"), "profile")) {
    team.profile = std::move(*profile);
  }
  team.colour = teamColour(text(json, "colour"));
  const Json* left = member(json, "attacksLeft");
  team.attacksLeft = left && left->is_boolean() && left->get<bool>();
  if (const Json* senders = member(json, "senders"); senders && senders->is_array()) {
    for (const Json& sender : *senders) {
      if (sender.is_string()) team.senders.push_back(sender.get<std::string>());
    }
  }
  if (const Json* robots = member(json, "robots"); robots && robots->is_object()) {
    for (const auto& [number, name] : robots->items()) {
      int value = 0;
      const auto read = std::from_chars(number.data(), number.data() + number.size(), value);
      if (read.ec == std::errc() && name.is_string() &&
          team.robots.size() < telemetry::TeamSetup::maxRobots) {
        team.robots[value] = name.get<std::string>();
      }
    }
  }
  return team;
}

Json optionsJson(const LiveOptions& options) {
  const telemetry::BatteryLimits& battery = options.team.battery;
  Json teams = Json::array();
  for (const telemetry::TeamSetup& team : options.team.teams) teams.push_back(teamJson(team));
  return Json{{"profile", telemetry::profileText(options.profile)},
              {"teams", std::move(teams)},
              {"field", options.field.name},
              {"ourTeam", options.ourTeam},
              {"refereeVersion", options.refereeVersion},
              {"colour", info(options.colour).name},
              {"colourByNumber", options.colourByNumber},
              {"timeout", options.team.timeout.count()},
              {"duplicateWindow", options.team.duplicateWindow.count()},
              {"battery",
               {{"cells", battery.cells},
                {"full", battery.fullPerCell},
                {"low", battery.lowPerCell},
                {"empty", battery.emptyPerCell}}}};
}

/// What is missing, or cannot be, keeps its default.
LiveOptions optionsFrom(const Json& json) {
  LiveOptions options;
  if (const std::string profile = text(json, "profile"); !profile.empty()) {
    if (auto read = telemetry::parseProfile(profile, "profile")) options.profile = *read;
  }
  constexpr std::size_t mostTeams = 16;
  if (const Json* teams = member(json, "teams"); teams && teams->is_array()) {
    for (const Json& team : *teams) {
      if (team.is_object() && options.team.teams.size() < mostTeams) {
        options.team.teams.push_back(teamFrom(team));
      }
    }
  }
  if (auto field = sim::fieldByName(text(json, "field"))) options.field = *field;
  options.ourTeam = whole<int>(json, "ourTeam");
  options.refereeVersion = whole<int>(json, "refereeVersion");
  options.colour = teamColour(text(json, "colour")).value_or(options.colour);
  const Json* byNumber = member(json, "colourByNumber");
  options.colourByNumber = byNumber && byNumber->is_boolean() && byNumber->get<bool>();
  options.team.timeout = Duration(whole(json, "timeout", options.team.timeout.count()));
  options.team.duplicateWindow =
      Duration(whole(json, "duplicateWindow", options.team.duplicateWindow.count()));
  if (const Json* limits = member(json, "battery"); limits && limits->is_object()) {
    telemetry::BatteryLimits& battery = options.team.battery;
    battery.cells = std::clamp(whole(*limits, "cells", battery.cells), 0, 1000);
    battery.fullPerCell = number(*limits, "full", battery.fullPerCell);
    battery.lowPerCell = number(*limits, "low", battery.lowPerCell);
    battery.emptyPerCell = number(*limits, "empty", battery.emptyPerCell);
  }
  return options;
}

}  // namespace

LiveBooks::LiveBooks(const LiveOptions& options)
    : monitor(options.profile, monitorOptions(options)), referee(refereeOptions(options)) {}

telemetry::RefereeTracker::Options LiveBooks::refereeOptions(const LiveOptions& options) {
  telemetry::RefereeTracker::Options made;
  made.version = options.refereeVersion;
  return made;
}

std::optional<telemetry::TeamMonitor::Verdict> LiveBooks::takeRobot(
    const telemetry::DatagramView& datagram, double time) {
  const telemetry::DatagramParts parts = telemetry::partsOf(datagram.payload);
  if (parts.drawing.empty()) return monitor.take(datagram);
  if (auto drawing = telemetry::parseDrawing(parts.drawing); !drawing) {
    // For a stranger's there is no need of a sentence.
    if (monitor.firstOfTeam(datagram, {})) (void)drawings.take(parts.drawing, time);
  } else if (const auto first = monitor.firstOfTeam(datagram, drawing->team)) {
    (void)drawings.take(std::move(*drawing), time, *first);
  }
  if (parts.message.empty()) return std::nullopt;
  telemetry::DatagramView message = datagram;
  message.payload = parts.message;
  return monitor.take(message);
}

void LiveBooks::clear(const LiveOptions& options) {
  monitor.clear();
  drawings.clear();
  referee = telemetry::RefereeTracker(refereeOptions(options));
  m_shown.reset();
  m_other.reset();
  m_trueData.reset();
  m_replies.clear();
}

void LiveBooks::takeReferee(const telemetry::RefereePacket& packet,
                            const telemetry::DatagramView& datagram) {
  const auto kept = [&datagram] {
    return Kept{datagram.time, datagram.sender, datagram.localPort, std::string(datagram.payload)};
  };
  const auto reply = [&](const telemetry::RobotReply& said, telemetry::Address robot) {
    referee.accept(said, robot, datagram.time);
    if (m_replies.size() < telemetry::RefereeTracker::maxReplies) {
      m_replies.insert_or_assign({said.team, said.player}, kept());
    }
  };
  if (const auto* state = std::get_if<RefereeState>(&packet)) {
    const bool shown = referee.accept(*state, datagram.sender, datagram.time);
    // Of packets that are not shown, only another referee's leaves something behind.
    const bool other = referee.sender() && referee.sender()->address != datagram.sender.address;
    if (state->trueData()) {
      m_trueData = kept();
    } else if (shown) {
      m_shown = kept();
    } else if (other) {
      m_other = kept();
    }
  } else if (const auto* said = std::get_if<telemetry::RobotReply>(&packet)) {
    reply(*said, datagram.sender.address);
  } else if (const auto* forwarded = std::get_if<telemetry::ForwardedReply>(&packet)) {
    reply(forwarded->reply, {forwarded->robot});
  }
}

MatchFrame LiveBooks::frame(const LiveOptions& options, const telemetry::TeamStatus& team,
                            double time) const {
  MatchFrame frame = liveFrame(options, team, referee, time);
  frame.drawings = drawings.at(time);
  frame.drawingProblem = drawings.lastProblem();
  return frame;
}

std::string LiveBooks::text(const LiveOptions& options, double time, WallTime zero) const {
  Json json{{"time", time}, {"options", optionsJson(options)}};
  // Its own text, not an object in here: the monitor's form is the monitor's.
  json["robots"] = monitor.robotsText(zero);
  for (const auto& [heard, drawn] : drawings.pages(time)) {
    json["drawings"].push_back(Json{{"at", heard}, {"text", drawn}});
  }
  Json& packets = json["referee"] = Json::array();
  const auto put = [&](const Kept& kept) {
    packets.push_back(Json{{"at", (kept.time - zero).count()},
                           {"address", kept.sender.address.value},
                           {"port", kept.sender.port},
                           {"localPort", kept.localPort},
                           {"base64", telemetry::toBase64(kept.payload)}});
  };
  for (const std::optional<Kept>* kept : {&m_shown, &m_trueData, &m_other}) {
    if (*kept) put(**kept);
  }
  for (const auto& [robot, kept] : m_replies) put(kept);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<LiveBooks::Read> LiveBooks::read(std::string_view bytes, WallTime zero) {
  const Json json = Json::parse(
      bytes, [](int depth, Json::parse_event_t, Json&) { return depth <= 8; }, false);
  const Json* options = json.is_object() ? member(json, "options") : nullptr;
  if (options == nullptr || !options->is_object()) {
    return failure(ErrorCode::ParseError, "This is no state of a live match.");
  }
  LiveOptions known = optionsFrom(*options);
  Read out{known, LiveBooks(known)};
  if (auto done = out.books.monitor.restoreRobots(pitchboard::link::text(json, "robots"), zero);
      !done) {
    return tl::unexpected(done.error());
  }
  if (const Json* pages = member(json, "drawings"); pages && pages->is_array()) {
    for (const Json& page : *pages) {
      if (!page.is_object()) continue;
      (void)out.books.drawings.take(pitchboard::link::text(page, "text"), number(page, "at", 0.0));
    }
  }
  if (const Json* packets = member(json, "referee"); packets && packets->is_array()) {
    for (const Json& packet : *packets) {
      if (!packet.is_object()) continue;
      const auto payload = telemetry::fromBase64(pitchboard::link::text(packet, "base64"));
      if (!payload) continue;
      const auto decoded = telemetry::decodeReferee(*payload);
      if (!decoded) continue;
      constexpr Duration century = std::chrono::hours(24 * 36'525);
      const Duration at =
          std::clamp(Duration(whole<std::int64_t>(packet, "at")), -century, century);
      const telemetry::Sender sender{{whole<std::uint32_t>(packet, "address")},
                                     whole<std::uint16_t>(packet, "port")};
      out.books.takeReferee(*decoded, {zero + at, sender, whole<std::uint16_t>(packet, "localPort"),
                                       false, *payload});
    }
  }
  return out;
}

}  // namespace pitchboard::link
