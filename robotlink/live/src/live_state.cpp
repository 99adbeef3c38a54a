// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_state.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include <robotlink/live/live_teams.h>
#include <telemetry/wire/base64.h>
#include <telemetry/wire/lenient_json.h>

#include "live_frame.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;
using telemetry::Duration;
using telemetry::RefereeState;
using telemetry::WallTime;

namespace lenient = telemetry::lenient;
using lenient::each;
using lenient::flag;
using lenient::member;
using lenient::number;
using lenient::whole;

/// With the profile itself: a setup names only its file.
Json teamJson(const telemetry::TeamSetup& team) {
  return Json{{"setup", telemetry::teamSetupText(team)},
              {"profile", telemetry::profileText(team.profile)}};
}

std::optional<telemetry::TeamSetup> teamFrom(const Json& json) {
  auto profile = telemetry::parseProfile(lenient::text(json, "profile"), "profile");
  if (!profile) return std::nullopt;
  auto team = telemetry::parseTeamSetup(lenient::text(json, "setup"), "setup", std::move(*profile));
  return team ? std::optional(std::move(*team)) : std::nullopt;
}

Json optionsJson(const LiveOptions& options) {
  const std::string ours(options.ourColour ? info(*options.ourColour).name : "");
  const telemetry::BatteryLimits& battery = options.team.battery;
  Json teams = Json::array();
  for (const telemetry::TeamSetup& team : options.team.teams) teams.push_back(teamJson(team));
  return Json{{"profile", telemetry::profileText(options.profile)},
              {"teams", std::move(teams)},
              {"field", options.field.name},
              {"ourTeam", options.ourTeam},
              {"refereeVersion", options.refereeVersion},
              {"ourColour", ours},
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
  if (const std::string profile = lenient::text(json, "profile"); !profile.empty()) {
    if (auto read = telemetry::parseProfile(profile, "profile")) options.profile = *read;
  }
  each(json, "teams", telemetry::TeamSetup::mostTeams, [&](std::size_t, const Json& team) {
    // A place without a team would give its robots to the next one.
    auto read = team.is_object() ? teamFrom(team) : std::nullopt;
    options.team.teams.push_back(read ? std::move(*read) : telemetry::TeamSetup{});
  });
  if (auto field = sim::fieldByName(lenient::text(json, "field"))) options.field = *field;
  options.ourTeam = whole<int>(json, "ourTeam");
  options.refereeVersion = whole<int>(json, "refereeVersion");
  options.ourColour = teamColorNamed(lenient::text(json, "ourColour"));
  options.colourByNumber = flag(json, "colourByNumber");
  options.team.timeout = Duration(whole(json, "timeout", options.team.timeout.count()));
  options.team.duplicateWindow =
      Duration(whole(json, "duplicateWindow", options.team.duplicateWindow.count()));
  if (const Json* limits = member(json, "battery"); limits && limits->is_object()) {
    telemetry::BatteryLimits battery = options.team.battery;
    battery.cells = std::clamp(whole(*limits, "cells", battery.cells), 0, 1000);
    battery.fullPerCell = number(*limits, "full").value_or(battery.fullPerCell);
    battery.lowPerCell = number(*limits, "low").value_or(battery.lowPerCell);
    battery.emptyPerCell = number(*limits, "empty").value_or(battery.emptyPerCell);
    constexpr double least = 0.05, most = 100.0;  // V of a cell
    const bool possible = battery.emptyPerCell >= 0.0 &&
                          battery.lowPerCell > battery.emptyPerCell &&
                          battery.fullPerCell > battery.lowPerCell &&
                          battery.fullPerCell >= least && battery.fullPerCell <= most;
    if (possible) options.team.battery = battery;
  }
  return options;
}

}  // namespace

LiveState::LiveState(const LiveOptions& options)
    : monitor(options.profile, monitorOptions(options)), referee(refereeOptions(options)) {}

telemetry::RefereeTracker::Options LiveState::refereeOptions(const LiveOptions& options) {
  telemetry::RefereeTracker::Options made;
  made.version = options.refereeVersion;
  return made;
}

void LiveState::setTeams(const telemetry::MonitorOptions& options) {
  monitor.setOptions(options);
  drawings.rename(monitor.renamings());
}

std::optional<telemetry::TeamMonitor::Verdict> LiveState::takeRobot(
    const telemetry::DatagramView& datagram, double time) {
  const auto take = [this](const telemetry::DatagramView& message) {
    const auto verdict = monitor.take(message);
    if (!monitor.renamings().empty()) drawings.rename(monitor.renamings());
    return verdict;
  };
  lastDrawer.reset();
  const telemetry::DatagramParts parts = telemetry::partsOf(datagram.payload);
  if (parts.drawing.empty()) return take(datagram);
  if (auto drawing = telemetry::parseDrawing(parts.drawing); !drawing) {
    // For a stranger's there is no need of a sentence.
    if (monitor.placeOf(datagram, {})) (void)drawings.take(parts.drawing, time);
  } else if (const auto place = monitor.placeOf(datagram, drawing->team)) {
    const RobotKey robot{*place, drawing->robot, 0};
    if (drawings.take(std::move(*drawing), time, *place)) lastDrawer = robot;
  }
  if (parts.message.empty()) return std::nullopt;
  telemetry::DatagramView message = datagram;
  message.payload = parts.message;
  return take(message);
}

void LiveState::clear(const LiveOptions& options) {
  monitor.clear();
  drawings.clear();
  referee = telemetry::RefereeTracker(refereeOptions(options));
  m_shown.reset();
  m_other.reset();
  m_trueData.reset();
  m_replies.clear();
}

void LiveState::takeReferee(const telemetry::RefereePacket& packet,
                            const telemetry::DatagramView& datagram) {
  const auto kept = [&datagram] {
    return Kept{datagram.time, datagram.sender, datagram.localPort, std::string(datagram.payload)};
  };
  const auto reply = [&](const telemetry::RobotReply& answer, telemetry::Address robot) {
    referee.accept(answer, robot, datagram.time);
    if (m_replies.size() < telemetry::RefereeTracker::maxReplies) {
      m_replies.insert_or_assign({answer.team, answer.player}, kept());
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
  } else if (const auto* answer = std::get_if<telemetry::RobotReply>(&packet)) {
    reply(*answer, datagram.sender.address);
  } else if (const auto* forwarded = std::get_if<telemetry::ForwardedReply>(&packet)) {
    reply(forwarded->reply, {forwarded->robot});
  }
}

MatchFrame LiveState::frame(const LiveOptions& options, const telemetry::TeamStatus& team,
                            double time) const {
  MatchFrame frame = liveFrame(options, team, referee, time);
  frame.drawings = drawings.at(time);
  frame.drawingProblem = drawings.lastProblem();
  return frame;
}

Teams LiveState::teams(const LiveOptions& options) const {
  return teamsOf(options, referee.state() ? &*referee.state() : nullptr);
}

std::string LiveState::text(const LiveOptions& options, double time, WallTime zero) const {
  Json json{{"time", time}, {"options", optionsJson(options)}};
  // Its own text, not an object in here: the monitor's form is the monitor's.
  json["robots"] = monitor.robotsText(zero);
  for (const auto& [received, place, drawn] : drawings.pages(time)) {
    json["drawings"].push_back(Json{{"at", received}, {"team", place}, {"text", drawn}});
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

Result<LiveState::Read> LiveState::read(std::string_view bytes, WallTime zero) {
  const Json json = lenient::parsed<Json>(bytes);
  const Json* options = json.is_object() ? member(json, "options") : nullptr;
  if (options == nullptr || !options->is_object()) {
    return failure(ErrorCode::ParseError, "This is not a saved state of a live match.");
  }
  LiveOptions known = optionsFrom(*options);
  Read out{known, LiveState(known)};
  if (auto done = out.state.monitor.restoreRobots(lenient::text(json, "robots"), zero); !done) {
    return tl::unexpected(done.error());
  }
  constexpr std::size_t mostPages =
      telemetry::DrawingLimits::robots * telemetry::DrawingLimits::layers;
  each(json, "drawings", mostPages, [&](std::size_t, const Json& page) {
    if (!page.is_object()) return;
    auto drawing = telemetry::parseDrawing(lenient::text(page, "text"));
    if (!drawing) return;
    int team = whole<int>(page, "team");
    if (member(page, "team") == nullptr) {  // of 0.8
      const RobotKey robot = keyOfOldId(drawing->robot, !known.team.teams.empty());
      drawing->robot = robot.number;
      team = robot.team;
    }
    (void)out.state.drawings.take(std::move(*drawing), number(page, "at").value_or(0.0), team);
  });
  constexpr std::size_t mostPackets = telemetry::RefereeTracker::maxReplies + 3;
  each(json, "referee", mostPackets, [&](std::size_t, const Json& packet) {
    if (!packet.is_object()) return;
    const auto payload = telemetry::fromBase64(lenient::text(packet, "base64"));
    if (!payload) return;
    const auto decoded = telemetry::decodeReferee(*payload);
    if (!decoded) return;
    constexpr Duration century = std::chrono::hours(24 * 36'525);
    const Duration at = std::clamp(Duration(whole<std::int64_t>(packet, "at")), -century, century);
    const telemetry::Sender sender{{whole<std::uint32_t>(packet, "address")},
                                   whole<std::uint16_t>(packet, "port")};
    out.state.takeReferee(
        *decoded, {zero + at, sender, whole<std::uint16_t>(packet, "localPort"), false, *payload});
  });
  return out;
}

}  // namespace pitchboard::link
