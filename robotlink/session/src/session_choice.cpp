// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_choice.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include <robotlink/frame/build_robot.h>
#include <robotlink/live/live_state.h>
#include <robotlink/live/live_teams.h>
#include <robotlink/session/live_moments.h>
#include <telemetry/wire/lenient_json.h>

namespace pitchboard::link {
namespace {

using telemetry::SessionStream;
using telemetry::WallTime;
using Json = nlohmann::ordered_json;
namespace lenient = telemetry::lenient;

/// What is theirs in the messages of a session, in the order of recording.
class Choice {
 public:
  Choice(const telemetry::SessionReader& session, std::vector<std::string> robots)
      : m_robots(std::move(robots)) {
    for (const telemetry::SessionGroup& group : session.groups()) {
      m_groups.push_back(group.info.name);
      if (const auto id = group.info.attributes.find("robot"); id != group.info.attributes.end()) {
        m_nameOfBoard[id->second] = group.info.name;
      }
    }
    m_isLive = session.count(SessionStream::LiveState) > 0;
  }

  /// False: it is not theirs. What is partly theirs is changed.
  bool keeps(SessionStream stream, std::string& json) {
    switch (stream) {
      case SessionStream::Events: {
        const std::string name = lenient::text(lenient::parsed<Json>(json), "group");
        return name.empty() || isChosen(name, m_robots);
      }
      case SessionStream::Log: {
        const std::string origin = lenient::text(lenient::parsed<Json>(json), "name");
        const std::string name = origin.substr(0, origin.find('/'));
        return !isChosen(name, m_groups) || isChosen(name, m_robots);
      }
      case SessionStream::Telemetry:
        return keepsDatagram(json);
      case SessionStream::Referee:
        return keepPlayers(json);
      case SessionStream::LiveState:
        return keepState(json);
      case SessionStream::RefereeRaw:
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
      const auto name =
          drawing ? m_nameOfBoard.find(std::to_string(drawing->robot)) : m_nameOfBoard.end();
      return name != m_nameOfBoard.end() && isChosen(name->second, m_robots);
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
    return robot.number > 0 && isChosen(nameOf(robot), m_robots);
  }

  std::string nameOf(const RobotKey& robot) const {
    return robotName(robot, m_known->state.teams(m_known->options));
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
        if (isChosen(name, m_robots)) kept.push_back(player);
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
      if (isChosen(nameOf(robot.key), m_robots)) continue;
      part->state.monitor.forget(robot.key);
    }
    part->state.drawings.forget(
        [&](const RobotKey& robot) { return !isChosen(nameOf(robot), m_robots); });
    text = part->state.text(part->options, time, WallTime{});
    return true;
  }

  std::vector<std::string> m_robots, m_groups;
  std::map<std::string, std::string> m_nameOfBoard;
  bool m_isLive = false;
  std::optional<LiveState::Read> m_known;  // of all robots
};

}  // namespace

bool isChosen(std::string_view name, std::span<const std::string> robots) {
  if (robots.empty()) return true;
  return std::ranges::any_of(robots, [&](const auto& robot) { return isSameRobot(name, robot); });
}

void keepRobots(MatchFrame& frame, std::span<const std::string> robots) {
  if (robots.empty()) return;
  std::erase_if(frame.robots,
                [&](const RobotFrame& robot) { return !isChosen(robot.name, robots); });
  std::erase_if(frame.drawings, [&frame](const telemetry::RobotDrawings& drawings) {
    return frame.robot(drawings.robot) == nullptr;
  });
  if (!frame.teamBalls.empty()) frame.teamBalls = agreedBalls(frame.robots);
}

std::vector<std::string> groupsNamed(const telemetry::SessionReader& session,
                                     std::vector<std::string> robots) {
  std::vector<std::string> groups;
  for (const telemetry::SessionGroup& group : session.groups()) groups.push_back(group.info.name);
  for (std::string& robot : robots) robot = robotNamed(robot, groups).value_or(robot);
  return robots;
}

void chooseRobots(const telemetry::SessionReader& session, telemetry::ExportFormat format,
                  telemetry::ExportSelection& selection) {
  if (selection.robots.empty()) return;
  const auto choice = std::make_shared<Choice>(session, selection.robots);
  // Datagrams behind the beginning say whose they are only on top of what was known there.
  auto opening = openingAt(session, selection.range.begin);
  for (auto& [stream, json] : opening) (void)choice->keeps(stream, json);
  if (format == telemetry::ExportFormat::Mcap) {
    selection.opening = std::move(opening);
    // The link of a robot has its own group.
    const std::vector<std::string> chosen = selection.robots;
    for (const telemetry::SessionGroup& group : session.groups()) {
      const auto robot = group.info.attributes.find("link");
      if (robot == group.info.attributes.end()) continue;
      if (std::ranges::find(chosen, robot->second) == chosen.end()) continue;
      selection.robots.push_back(group.info.name);
    }
  }
  selection.change = [choice](SessionStream stream, std::string& json) {
    return choice->keeps(stream, json);
  };
}

}  // namespace pitchboard::link
