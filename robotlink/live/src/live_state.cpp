// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_state.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include <base/base64.h>
#include <base/lenient_json.h>
#include <base/option_json.h>
#include <robotlink/live/live_teams.h>

#include "live_frame.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;
using telemetry::Duration;
using telemetry::RefereeState;
using telemetry::WallTime;

namespace lenient = lenient;
using lenient::each;
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
  Json teams = Json::array();
  for (const telemetry::TeamSetup& team : options.team.teams) teams.push_back(teamJson(team));
  Json json{{"profile", telemetry::profileText(options.profile)},
            {"teams", std::move(teams)},
            {"duplicateWindow", options.team.duplicateWindow.count()}};
  writeOptions<Json, LiveOptions>(json, liveOptionTable(), options);
  return json;
}

/// Options as they were written up to version 0.22.
Json presentForm(Json json) {
  if (const Json* ours = member(json, "ourTeam"); ours && ours->is_number_integer()) {
    const std::string colour = lenient::text(json, "ourColour");
    json["ourTeam"] = colour.empty() ? std::to_string(whole<int>(json, "ourTeam")) : colour;
  }
  if (const Json* timeout = member(json, "timeout"); timeout && timeout->is_number_integer()) {
    json["timeout"] = telemetry::secondsOf(Duration(whole<std::int64_t>(json, "timeout")));
  }
  const Json battery = json.value("battery", Json());
  for (const auto& [before, now] :
       {std::pair("cells", "cells"), std::pair("full", "fullPerCell"),
        std::pair("low", "lowPerCell"), std::pair("empty", "emptyPerCell")}) {
    if (battery.is_object() && battery.contains(before)) json[now] = battery[before];
  }
  return json;
}

/// What is missing, or cannot be, keeps its default.
LiveOptions optionsFrom(const Json& json) {
  LiveOptions options;
  if (const std::string profile = lenient::text(json, "profile"); !profile.empty()) {
    if (auto read = telemetry::parseProfile(profile, "profile")) options.profile = *read;
  }
  each(json, "teams", telemetry::TeamSetup::maxTeams, [&](std::size_t, const Json& team) {
    // A place without a team would give its robots to the next one.
    auto read = team.is_object() ? teamFrom(team) : std::nullopt;
    options.team.teams.push_back(read ? std::move(*read) : telemetry::TeamSetup{});
  });
  options.team.duplicateWindow =
      Duration(whole(json, "duplicateWindow", options.team.duplicateWindow.count()));
  readOptions(presentForm(json), liveOptionTable(), options);
  if (!isPossible(options.team.battery)) options.team.battery = LiveOptions().team.battery;
  return options;
}

Json uidsJson(const RobotUids& uids) {
  Json robots = Json::array();
  for (const RobotUids::Known& known : uids.known()) {
    Json& one = robots.emplace_back(Json{{"uid", known.uid.value},
                                         {"number", known.number},
                                         {"team", known.place},
                                         {"address", known.sender.value},
                                         {"variables", known.sendsVariables}});
    if (known.key) one["sender"] = known.key->sender;
  }
  return robots;
}

/// Returns null if a session before 0.23 kept none.
std::shared_ptr<RobotUids> uidsFrom(const Json& json) {
  const Json* kept = member(json, "uids");
  if (kept == nullptr || !kept->is_array()) return nullptr;
  std::vector<RobotUids::Known> all;
  each(json, "uids", RobotUids::maxRobots, [&all](std::size_t, const Json& one) {
    if (!one.is_object()) return;
    RobotUids::Known& known = all.emplace_back();
    known.uid = {whole<std::uint32_t>(one, "uid")};
    known.number = whole<int>(one, "number");
    known.place = whole<int>(one, "team");
    known.sender = {whole<std::uint32_t>(one, "address")};
    known.sendsVariables = lenient::flag(one, "variables");
    if (member(one, "sender") == nullptr) return;
    known.key = RobotKey{known.place, known.number, whole<int>(one, "sender")};
  });
  return std::make_shared<RobotUids>(std::move(all));
}

}  // namespace

LiveState::LiveState(const LiveOptions& options)
    : monitor(options.profile, monitorOptions(options)), referee(refereeOptions(options)) {}

telemetry::RefereeTracker::Options LiveState::refereeOptions(const LiveOptions& options) {
  telemetry::RefereeTracker::Options made;
  made.version = options.refereeVersion;
  made.prefersReal = true;
  return made;
}

void LiveState::setTeams(const telemetry::MonitorOptions& options) {
  monitor.setOptions(options);
  followKeys();
}

/// The monitor may have given robots other keys.
void LiveState::followKeys() {
  if (monitor.renamings().empty()) return;
  drawings.rename(monitor.renamings());
  if (uids) uids->rename(monitor.renamings());
}

void LiveState::forget(const RobotKey& robot) {
  monitor.forget(robot);
  followKeys();
}

std::optional<telemetry::TeamMonitor::Verdict> LiveState::takeRobot(
    const telemetry::DatagramView& datagram, double time) {
  const auto take = [this](const telemetry::DatagramView& message) {
    const auto verdict = monitor.take(message);
    followKeys();
    if (uids && verdict == telemetry::TeamMonitor::Verdict::Used) {
      uids->ofMessages(monitor.used(), message.sender.address);
    }
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

void LiveState::forgetSimulated(const LiveOptions& options) {
  for (const telemetry::RobotStatus& robot : monitor.status({}).robots) {
    if (robot.key.team == telemetry::simulatedTeam) forget(robot.key);
  }
  if (referee.sender() && telemetry::isSimulated(referee.sender()->address)) forgetReferee(options);
}

void LiveState::forgetReferee(const LiveOptions& options) {
  referee = telemetry::RefereeTracker(refereeOptions(options));
  m_former.reset();
  m_shown.reset();
  m_late.reset();
  m_other.reset();
  m_trueData.reset();
  m_replies.clear();
}

void LiveState::clear(const LiveOptions& options) {
  monitor.clear();
  drawings.clear();
  forgetReferee(options);
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
    using Verdict = telemetry::RefereeTracker::Verdict;
    const std::optional<telemetry::Sender> before = referee.sender();
    switch (referee.accept(*state, datagram.sender, datagram.time)) {
      case Verdict::TrueData:
        m_trueData = kept();
        break;
      case Verdict::Shown:
        if (before && before->address != datagram.sender.address) m_former.reset();
        if (before && before->address == datagram.sender.address &&
            before->port != datagram.sender.port) {
          m_former = m_shown;
        }
        m_shown = kept();
        break;
      case Verdict::Repeated:
        m_shown = kept();
        break;
      case Verdict::OtherSender:
        m_other = kept();
        break;
      case Verdict::Late:
        if (referee.lateSince() == datagram.time) m_late = kept();
        break;
      case Verdict::Compatibility:
      case Verdict::Simulated:
      case Verdict::OtherVersion:
        break;  // leave nothing behind
    }
    if (!referee.lateSince()) m_late.reset();
  } else if (const auto* answer = std::get_if<telemetry::RobotReply>(&packet)) {
    reply(*answer, datagram.sender.address);
  } else if (const auto* forwarded = std::get_if<telemetry::ForwardedReply>(&packet)) {
    reply(forwarded->reply, {forwarded->robot});
  }
}

MatchFrame LiveState::frame(const LiveOptions& options, const telemetry::TeamStatus& team,
                            double time) const {
  MatchFrame frame = liveFrame(options, team, referee, time);
  for (RobotFrame& robot : frame.robots) {
    robot.uid = uids ? uids->withKey(robot.key) : uidOf(robot.key);
  }
  frame.drawings = drawings.at(time);
  frame.drawingProblem = drawings.lastProblem();
  return frame;
}

Teams LiveState::teams(const LiveOptions& options) const {
  return teamsOf(options, referee.game());
}

std::string LiveState::text(const LiveOptions& options, double time, WallTime zero) const {
  Json json{{"time", time}, {"options", optionsJson(options)}};
  // Its own text, not an object in here: the monitor's form is the monitor's.
  json["robots"] = monitor.robotsText(zero);
  if (uids) json["uids"] = uidsJson(*uids);
  for (const auto& [received, place, drawn] : drawings.pages(time)) {
    json["drawings"].push_back(Json{{"at", received}, {"team", place}, {"text", drawn}});
  }
  Json& packets = json["referee"] = Json::array();
  const auto put = [&](const Kept& kept) {
    packets.push_back(Json{{"at", (kept.time - zero).count()},
                           {"address", kept.sender.address.value},
                           {"port", kept.sender.port},
                           {"localPort", kept.localPort},
                           {"base64", toBase64(kept.payload)}});
  };
  for (const std::optional<Kept>* kept : {&m_former, &m_shown, &m_late, &m_trueData, &m_other}) {
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
  out.state.uids = uidsFrom(json);
  if (auto done = out.state.monitor.restoreRobots(lenient::text(json, "robots"), zero); !done) {
    return tl::unexpected(done.error());
  }
  constexpr std::size_t maxPages =
      telemetry::DrawingLimits::robots * telemetry::DrawingLimits::layers;
  each(json, "drawings", maxPages, [&](std::size_t, const Json& page) {
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
  constexpr std::size_t maxPackets = telemetry::RefereeTracker::maxReplies + 5;
  each(json, "referee", maxPackets, [&](std::size_t, const Json& packet) {
    if (!packet.is_object()) return;
    const auto payload = fromBase64(lenient::text(packet, "base64"));
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
