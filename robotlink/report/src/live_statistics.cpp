// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <robotlink/session/live_moments.h>
#include <robotlink/session/session_events.h>
#include <simcore/world/action.h>

namespace pitchboard::link {
namespace {

constexpr double shortestStep = 0.1;  // s; actions and places change a few times a second
constexpr double mostMoments = 36'000;

struct Robot {
  RobotSummary out;
  std::optional<Point> anchor;
  double way = 0.0;      // m
  double present = 0.0;  // s since its first message
  bool wasKicking = false, wasFallen = false;
  std::array<double, telemetry::processCount> worked{}, known{};
};

class Walk {
 public:
  explicit Walk(telemetry::TimeRange range) : m_range(range) {}

  void add(const MatchFrame& frame, double step) {
    for (const RobotFrame& robot : frame.robots) {
      if (robot.health) add(frame, robot, step);
    }
    m_last = frame;
  }

  SessionStatistics finish(const std::vector<MatchEvent>& events) {
    for (const MatchEvent& event : events) {
      if (event.time < m_range.begin || event.time > m_range.end) continue;
      const auto found = m_robots.find(event.robot);
      if (found == m_robots.end()) continue;
      RobotSummary::Link& link = *found->second.out.link;
      if (event.kind == MatchEventKind::RobotSilent) ++link.silences;
      if (event.kind == MatchEventKind::Penalised) ++link.penalties;
    }
    SessionStatistics out;
    out.range = m_range;
    std::map<TeamColor, TeamSummary> teams;
    for (auto& [id, robot] : m_robots) {
      RobotSummary& s = robot.out;
      if (robot.anchor) s.distance = robot.way;
      for (std::size_t i = 0; i < s.uptime.size(); ++i) {
        if (robot.known[i] > 0.0) s.uptime[i] = robot.worked[i] / robot.known[i];
      }
      if (robot.present > 0.0) s.link->heard = s.seconds / robot.present;
      if (id.sender > 0 && !isAttached(id)) s.name += " (second)";
      TeamSummary& team = teams[s.team];
      team.team = s.team;
      team.ballSeconds += s.ballSeconds;
      team.kicks += s.kicks;
      team.falls += s.falls;
      team.distance += s.distance.value_or(0.0);
      out.robots.push_back(s);
    }
    score(teams);
    const double part = (m_range.end - m_range.begin) / static_cast<double>(parts);
    for (auto& [colour, team] : teams) {
      const auto curve = m_possession.find(colour);
      for (std::size_t i = 0; curve != m_possession.end() && part > 0.0 && i < parts; ++i) {
        team.ballCurve.push_back(std::min(1.0, curve->second[i] / part));
      }
      out.teams.push_back(std::move(team));
    }
    std::ranges::stable_sort(out.robots,
                             [](const auto& a, const auto& b) { return a.team < b.team; });
    return out;
  }

 private:
  static constexpr std::size_t parts = StatisticsBuilder::parts;

  /// Both teams of the referee, also the one of which no robot is heard.
  void score(std::map<TeamColor, TeamSummary>& teams) const {
    if (!m_last.referee) return;
    for (const RefereeTeamView& side : m_last.referee->teams) {
      const auto colour = std::ranges::find(teamColors, side.colour, &TeamColorInfo::name);
      if (colour == teamColors.end()) continue;
      TeamSummary& team = teams[colour->color];
      team.team = colour->color;
      team.score = side.score;
    }
  }

  void add(const MatchFrame& frame, const RobotFrame& seen, double step) {
    const auto [entry, isNew] = m_robots.try_emplace(seen.key);
    Robot& robot = entry->second;
    const RobotHealth& health = *seen.health;
    RobotSummary& out = robot.out;
    if (isNew) out.link = RobotSummary::Link{};  // clang 14 refuses emplace() here
    // Colours may come late, with the referee.
    out.name = seen.name;
    out.team = seen.identity.team;
    out.link->messages = health.messages;
    out.link->loss = health.loss;
    robot.present += step;
    if (health.timedOut) return;
    out.seconds += step;
    if (health.battery && health.battery->volts > 0.0) {
      out.link->leastVolts =
          std::min(out.link->leastVolts.value_or(health.battery->volts), health.battery->volts);
    }
    const bool kicking = health.action && isKick(*health.action);
    if (kicking && !robot.wasKicking) ++out.kicks;
    robot.wasKicking = kicking;
    if (seen.fallen && !robot.wasFallen) ++out.falls;
    robot.wasFallen = seen.fallen;
    for (std::size_t i = 0; i < health.processes.size(); ++i) {
      const telemetry::ProcessState state = health.processes[i].state;
      if (state == telemetry::ProcessState::Unknown) continue;
      robot.known[i] += step;
      if (state == telemetry::ProcessState::Working) robot.worked[i] += step;
    }
    if (!health.poseKnown) return;
    const Point here = seen.pose.position;
    if (!robot.anchor) robot.anchor = here;
    const double way = std::hypot(here.x - robot.anchor->x, here.y - robot.anchor->y);
    if (way >= leastMove) {
      robot.way += way;
      robot.anchor = here;
    }
    if (!health.ball || std::hypot(health.ball->x - here.x, health.ball->y - here.y) > ballReach) {
      return;
    }
    out.ballSeconds += step;
    auto& curve = m_possession[out.team];
    curve.resize(parts, 0.0);
    const double length = std::max(m_range.end - m_range.begin, 1e-9);
    const double share = (frame.snapshot.time - m_range.begin) / length;
    curve[static_cast<std::size_t>(std::clamp(share * static_cast<double>(parts), 0.0,
                                              static_cast<double>(parts - 1)))] += step;
  }

  telemetry::TimeRange m_range;
  std::map<RobotKey, Robot> m_robots;
  std::map<TeamColor, std::vector<double>> m_possession;
  MatchFrame m_last;
};

}  // namespace

bool isKick(int code) {
  const sim::Action* action = sim::findAction(code);
  return action && action->kind == ActionKind::Kick;
}

SessionStatistics liveStatistics(const telemetry::SessionReader& session,
                                 telemetry::TimeRange range) {
  Walk walk(range);
  LiveMoments moments;
  const SessionHistory history(session);
  const double length = range.end - range.begin;
  const double step = std::max(shortestStep, length / mostMoments);
  const auto count = static_cast<std::uint64_t>(std::max(length, 0.0) / step);
  for (std::uint64_t i = 0; i <= count; ++i) {
    // The last one is the end itself: the score that counts may come with the last packet.
    const double time = i == count ? range.end : range.begin + step * static_cast<double>(i);
    if (const auto frame = moments.frameAt(history, time)) walk.add(*frame, step);
  }
  SessionStatistics out = walk.finish(eventsOf(session));
  for (const telemetry::SessionGroup& group : session.groups()) out.rows += group.rows;
  return out;
}

}  // namespace pitchboard::link
