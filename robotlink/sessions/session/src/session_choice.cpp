// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_choice.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include <base/lenient_json.h>
#include <base/try.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/live/live_state.h>
#include <robotlink/live/live_teams.h>
#include <robotlink/session/live_moments.h>
#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::link {
namespace {

using telemetry::SessionStream;
using telemetry::WallTime;
using Json = nlohmann::ordered_json;
namespace lenient = lenient;

/// What is theirs in the messages of a session, in the order of recording.
class Choice {
 public:
  Choice(const telemetry::SessionReader& session, RobotChoice robots)
      : m_session(session), m_robots(std::move(robots)) {
    m_isLive = session.count(SessionStream::LiveState) > 0;
    if (!m_isLive || !session.range()) return;
    for (const auto& [stream, json] : openingAt(session, session.range()->end)) {
      const auto last = LiveState::read(json, WallTime{});
      if (last) m_lastTeams = last->state.teams(last->options);
    }
  }

  /// False: it is not theirs. What is partly theirs is changed.
  bool keeps(SessionStream stream, std::string& json) {
    switch (stream) {
      case SessionStream::Events: {
        const Json event = lenient::parsed<Json>(json);
        const std::string name = lenient::text(event, "group");
        const RobotUid robot{lenient::whole<std::uint32_t>(event, "uid")};
        if (name.empty()) return true;
        return robot == RobotUid{} ? isTheirsNow(name) : m_robots.has(robot, name);
      }
      case SessionStream::Log: {
        const std::string origin = lenient::text(lenient::parsed<Json>(json), "name");
        const std::string name = origin.substr(0, origin.find('/'));
        return !m_session.groupsNamed(name) || isTheirsNow(name);
      }
      case SessionStream::Telemetry:
        return keepsDatagram(json);
      case SessionStream::Referee:
        return keepPlayers(json);
      case SessionStream::LiveState:
        return keepState(json);
      case SessionStream::RefereeRaw:
        takeReferee(json);
        return true;
      case SessionStream::Checkpoints:
        return false;
    }
    return false;
  }

 private:
  bool keepsDatagram(const std::string& json) {
    const auto kept = telemetry::sessionDatagram(json);
    if (!kept) return false;
    const auto drawn = telemetry::partsOf(kept->payload).drawing;
    const auto drawing = telemetry::parseDrawing(drawn);
    if (!m_isLive) {
      // In a simulated match robots say only what they draw.
      return drawing && m_robots.has(uidOf(RobotId{drawing->robot}), {});
    }
    if (!m_known) return false;
    const telemetry::DatagramView datagram{
        WallTime(telemetry::Duration(std::llround(kept->time * 1e9))), kept->sender,
        kept->localPort, false, kept->payload};
    telemetry::TeamMonitor& monitor = m_known->state.monitor;
    RobotKey robot;
    if (const auto verdict = m_known->state.takeRobot(datagram, kept->time)) {
      robot = {monitor.decoded().place, monitor.decoded().robot, 0};
      if (*verdict == telemetry::TeamMonitor::Verdict::Used) robot = monitor.used();
    } else if (drawing) {
      const auto place = monitor.placeOf(datagram, drawing->team);
      if (place) robot = {*place, drawing->robot, 0};
    }
    return robot.number > 0 && isTheirs(robot);
  }

  void takeReferee(const std::string& json) {
    const auto kept = telemetry::sessionDatagram(json);
    if (!m_known || !kept) return;
    const auto packet = telemetry::decodeReferee(kept->payload);
    if (!packet) return;
    const WallTime time(telemetry::Duration(std::llround(kept->time * 1e9)));
    m_known->state.takeReferee(*packet,
                               {time, kept->sender, kept->localPort, false, kept->payload});
  }

  bool isTheirs(const RobotKey& robot) const {
    const auto& uids = m_known->state.uids;
    return m_robots.has(uids ? uids->withKey(robot) : RobotUid{}, robotName(robot, m_lastTeams));
  }
  /// Of the robot that has this name at this moment of the recording.
  bool isTheirsNow(const std::string& name) const {
    if (m_known) {
      const Teams teams = m_known->state.teams(m_known->options);
      for (const telemetry::RobotStatus& robot : m_known->state.monitor.status(WallTime{}).robots) {
        if (robotName(robot.key, teams) == name) return isTheirs(robot.key);
      }
    }
    return m_robots.has(robotNamed(m_session, name), name);
  }

  bool keepPlayers(std::string& text) const {
    Json json = lenient::parsed<Json>(text);
    const auto teams = json.is_object() ? json.find("teams") : json.end();
    if (teams == json.end() || !teams->is_array()) return true;
    for (Json& team : *teams) {
      const auto players = team.is_object() ? team.find("players") : team.end();
      if (players == team.end() || !players->is_array()) continue;
      const auto colour = teamColorNamed(lenient::text(team, "colourName"));
      const std::string before = colour ? std::string(info(*colour).letter) : "Robot ";
      Json kept = Json::array();
      for (const Json& player : *players) {
        const int number = player.is_object() ? lenient::whole<int>(player, "n") : 0;
        const std::string name = before + std::to_string(number);
        if (isTheirsNow(name)) kept.push_back(player);
      }
      *players = std::move(kept);
    }
    text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return true;
  }

  bool keepState(std::string& text) {
    auto all = LiveState::read(text, WallTime{});
    auto part = LiveState::read(text, WallTime{});
    if (!all || !part) return false;
    m_known.emplace(std::move(*all));
    const double time = lenient::number(lenient::parsed<Json>(text), "time").value_or(0.0);
    const WallTime now(telemetry::Duration(std::llround(time * 1e9)));
    // Backwards: when the first program of a number is forgotten, the next one moves up.
    auto robots = m_known->state.monitor.status(now).robots;
    std::ranges::reverse(robots);
    for (const telemetry::RobotStatus& robot : robots) {
      if (isTheirs(robot.key)) continue;
      part->state.forget(robot.key);
    }
    if (part->state.uids) {
      std::vector<RobotKey> kept;
      for (const auto& robot : part->state.monitor.status(now).robots) kept.push_back(robot.key);
      part->state.uids->keepOnly(kept);
    }
    part->state.drawings.forget([&](const RobotKey& robot) { return !isTheirs(robot); });
    text = part->state.text(part->options, time, WallTime{});
    return true;
  }

  const telemetry::SessionReader& m_session;
  RobotChoice m_robots;
  bool m_isLive = false;
  Teams m_lastTeams;                       // as they are known at the end
  std::optional<LiveState::Read> m_known;  // of all robots
};

}  // namespace

RobotUid uidOf(const telemetry::GroupInfo& group, telemetry::GroupId index) {
  const telemetry::RobotFacts& facts = factsOf(group);
  if (facts.uid != RobotUid{}) return facts.uid;
  if (facts.attached) return uidOfBoard(facts.boardKey.value_or(0));
  const bool isSimulated = !facts.live && facts.sentFrom.empty() && facts.slot > 0;
  if (isSimulated) return uidOf(RobotId{facts.slot});
  if (!group.robot) return {};
  // No message has such a key.
  return uidOf(RobotKey{0, facts.number, 256 + static_cast<int>(index)});
}

RobotUid robotNamed(const telemetry::SessionReader& session, std::string_view name) {
  const auto groups = session.groupsNamed(name);
  if (!groups) return {};
  return uidOf(session.groups()[groups->front()].info, groups->front());
}

Result<RobotChoice> RobotChoice::of(const telemetry::SessionReader& session,
                                    std::span<const std::string> names) {
  RobotChoice made;
  made.m_isAll = names.empty();
  for (const std::string& name : names) {
    const std::vector<telemetry::GroupId> groups = TRY(session.groupsNamed(name));
    for (const telemetry::GroupId id : groups) {
      const telemetry::GroupInfo& group = session.groups()[id].info;
      made.m_robots.insert(uidOf(group, id));
      const telemetry::RobotFacts& facts = factsOf(group);
      if (facts.uid != RobotUid{}) continue;
      made.m_names.insert(group.name);
      made.m_names.insert(facts.formerNames.begin(), facts.formerNames.end());
    }
  }
  return made;
}

bool RobotChoice::has(RobotUid robot, const std::string& name) const {
  return m_isAll || (robot != RobotUid{} && m_robots.contains(robot)) || m_names.contains(name);
}

void keepRobots(MatchFrame& frame, const RobotChoice& robots) {
  if (robots.isAll()) return;
  std::erase_if(frame.robots,
                [&](const RobotFrame& robot) { return !robots.has(robot.uid, robot.name); });
  std::erase_if(frame.drawings, [&frame](const telemetry::RobotDrawings& drawings) {
    return frame.robot(drawings.robot) == nullptr;
  });
  if (!frame.teamBalls.empty()) frame.teamBalls = agreedBalls(frame.robots);
}

Result<void> chooseRobots(const telemetry::SessionReader& session, telemetry::ExportFormat format,
                          telemetry::ExportSelection& selection) {
  if (selection.robots.empty()) return {};
  RobotChoice robots = TRY(RobotChoice::of(session, selection.robots));
  const auto choice = std::make_shared<Choice>(session, robots);
  // Datagrams behind the beginning say whose they are only on top of what was known there.
  auto opening = openingAt(session, selection.range.begin);
  for (auto& [stream, json] : opening) (void)choice->keeps(stream, json);
  if (format == telemetry::ExportFormat::Mcap) {
    selection.opening = std::move(opening);
    // The link of a robot has its own group.
    for (const telemetry::SessionGroup& group : session.groups()) {
      const telemetry::RobotFacts& facts = factsOf(group.info);
      if (!facts.linkOf.empty() && robots.has(facts.uid, facts.linkOf)) {
        selection.robots.push_back(group.info.name);
      }
    }
  }
  selection.change = [choice](SessionStream stream, std::string& json) {
    return choice->keeps(stream, json);
  };
  return {};
}

}  // namespace pitchboard::link
