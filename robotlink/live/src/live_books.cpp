// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_books.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <robotlink/frame/second_sender.h>
#include <telemetry/wire/base64.h>

#include "live_frame.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;
using telemetry::Duration;
using telemetry::WallTime;

constexpr std::size_t mostIdentities = 4096;

Json keptJson(WallTime time, const telemetry::Sender& sender, const std::string& payload,
              WallTime zero) {
  return Json{{"at", (time - zero).count()},
              {"address", sender.address.value},
              {"port", sender.port},
              {"base64", telemetry::toBase64(payload)}};
}

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

Json optionsJson(const LiveOptions& options) {
  const telemetry::BatteryLimits& battery = options.team.battery;
  return Json{{"profile", telemetry::profileText(options.profile)},
              {"field", options.field.name},
              {"ourTeam", options.ourTeam},
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
  if (auto field = sim::fieldByName(text(json, "field"))) options.field = *field;
  options.ourTeam = whole<int>(json, "ourTeam");
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

RobotId LiveIdentities::idOf(int number, std::uint64_t serial) {
  const auto [entry, isNew] = m_ids.try_emplace({number, serial});
  if (!isNew) return entry->second;
  entry->second = idOfSender(number, [&](RobotId wanted) {
    return std::any_of(m_ids.begin(), m_ids.end(),
                       [&](const auto& known) { return known.second == wanted; });
  });
  return entry->second;
}

void LiveIdentities::keepOnly(const telemetry::TeamStatus& team) {
  std::erase_if(m_ids, [&team](const auto& entry) {
    return std::none_of(team.robots.begin(), team.robots.end(), [&entry](const auto& robot) {
      return robot.number == entry.first.first && robot.serial == entry.first.second;
    });
  });
}

LiveBooks::LiveBooks(const LiveOptions& options) : monitor(options.profile, options.team) {}

void LiveBooks::clear() {
  monitor.clear();
  referee = {};
  identities.clear();
  m_shown.reset();
  m_other.reset();
  m_trueData.reset();
}

void LiveBooks::takeReferee(const telemetry::RefereeState& state,
                            const telemetry::DatagramView& datagram) {
  const bool shown = referee.accept(state, datagram.sender, datagram.time);
  // Of the datagrams that were not shown, only another referee's leaves something behind.
  const bool other = referee.sender() && referee.sender()->address != datagram.sender.address;
  std::optional<Kept>* kept = state.trueData() ? &m_trueData
                              : shown          ? &m_shown
                              : other          ? &m_other
                                               : nullptr;
  if (kept) *kept = {datagram.time, datagram.sender, std::string(datagram.payload)};
}

MatchFrame LiveBooks::frame(const LiveOptions& options, const telemetry::TeamStatus& team,
                            double time) {
  identities.keepOnly(team);
  return liveFrame(options, team, referee, identities, time);
}

std::string LiveBooks::text(const LiveOptions& options, double time, WallTime zero) const {
  Json json{{"time", time}, {"options", optionsJson(options)}};
  // Its own text, not an object in here: the monitor's form is the monitor's.
  json["robots"] = monitor.robotsText(zero);
  Json& ids = json["ids"] = Json::array();
  for (const auto& [robot, id] : identities.m_ids) {
    ids.push_back(Json{{"number", robot.first}, {"serial", robot.second}, {"id", id.value}});
  }
  Json& packets = json["referee"] = Json::array();
  for (const std::optional<Kept>* kept : {&m_shown, &m_trueData, &m_other}) {
    if (*kept) packets.push_back(keptJson((*kept)->time, (*kept)->sender, (*kept)->payload, zero));
  }
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
  if (const Json* ids = member(json, "ids"); ids && ids->is_array()) {
    for (const Json& id : *ids) {
      if (!id.is_object() || out.books.identities.m_ids.size() >= mostIdentities) continue;
      out.books.identities.m_ids[{whole<int>(id, "number"), whole<std::uint64_t>(id, "serial")}] = {
          whole<int>(id, "id")};
    }
  }
  if (const Json* packets = member(json, "referee"); packets && packets->is_array()) {
    for (const Json& packet : *packets) {
      if (!packet.is_object()) continue;
      const auto payload = telemetry::fromBase64(pitchboard::link::text(packet, "base64"));
      if (!payload) continue;
      const auto decoded = telemetry::decodeReferee(*payload);
      const auto* state =
          decoded ? std::get_if<telemetry::RefereeState>(&*decoded) : nullptr;
      if (state == nullptr) continue;
      constexpr Duration century = std::chrono::hours(24 * 36'525);
      const Duration at =
          std::clamp(Duration(whole<std::int64_t>(packet, "at")), -century, century);
      out.books.takeReferee(
          *state, {zero + at,
                   {{whole<std::uint32_t>(packet, "address")}, whole<std::uint16_t>(packet, "port")},
                   0,
                   false,
                   *payload});
    }
  }
  return out;
}

}  // namespace pitchboard::link
