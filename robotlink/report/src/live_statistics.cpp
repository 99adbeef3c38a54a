// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>
#include <simcore/world/action.h>

namespace pitchboard::link {
namespace {

constexpr double shortestStep = 0.1;  // s; actions and places change a few times a second
constexpr double mostMoments = 36'000;

struct Robot {
  RobotSummary out;
  std::optional<Point> anchor;
  double travelled = 0.0;  // m
  double present = 0.0;    // s since its first message
  bool wasKicking = false, wasFallen = false;
  std::array<double, telemetry::processCount> worked{}, known{};
};

/// m; believed places tremble by less.
constexpr double leastMove = 0.1;

bool isKick(int code) {
  const sim::Action* action = sim::findAction(code);
  return action && action->kind == ActionKind::Kick;
}

class Walk {
 public:
  explicit Walk(telemetry::TimeRange range) : m_range(range), m_sums(range) {}

  void add(const MatchFrame& frame, double step) {
    for (const RobotFrame& robot : frame.robots) {
      if (robot.link) add(frame, robot, step);
    }
    if (frame.referee) seeScores(*frame.referee);
    m_last = frame;
  }

  SessionStatistics finish(const std::vector<MatchEvent>& events) {
    for (const MatchEvent& event : events) {
      if (event.time < m_range.begin || event.time > m_range.end) continue;
      const auto found = m_robots.find(event.robot);
      if (found == m_robots.end()) continue;
      RobotSummary::Link& link = *found->second.out.link;
      if (event.kind == MatchEventKind::RobotOffline) ++link.outages;
      if (event.kind == MatchEventKind::Penalised) ++link.penalties;
    }
    for (auto& [id, robot] : m_robots) {
      RobotSummary& s = robot.out;
      if (robot.anchor) s.distance = robot.travelled;
      for (std::size_t i = 0; i < s.uptime.size(); ++i) {
        if (robot.known[i] > 0.0) s.uptime[i] = robot.worked[i] / robot.known[i];
      }
      if (robot.present > 0.0) s.link->received = s.seconds / robot.present;
      s.order = orderOf(id, m_last.teams);
      const auto place = static_cast<std::size_t>(id.team);
      if (place < m_last.teams.size()) m_sums.team(s.team).name = m_last.teams[place].name;
      m_sums.add(s);
    }
    // Both teams of the referee, even if no robot of one of them was received.
    for (std::size_t i = 0; m_last.referee && i < m_last.referee->teams.size(); ++i) {
      const RefereeTeamView& side = m_last.referee->teams[i];
      const auto colour = teamColorNamed(side.colour);
      if (!colour) continue;
      TeamSummary& team = m_sums.team(*colour);
      team.score = side.score;
      team.number = side.number;
      team.byHalf = m_halves[side.number].goals();
      if (!side.name.empty()) team.name = side.name;
    }
    return m_sums.finish();
  }

 private:
  void seeScores(const RefereeView& referee) {
    if (referee.phase == "penalty shoot-out") return;
    const std::size_t first = referee.phase == "overtime" ? 2 : 0;
    for (const RefereeTeamView& team : referee.teams) {
      m_halves[team.number].see(first + (referee.firstHalf ? 0 : 1), team.score);
    }
  }
  void add(const MatchFrame& frame, const RobotFrame& seen, double step) {
    const auto [entry, isNew] = m_robots.try_emplace(seen.key);
    Robot& robot = entry->second;
    const telemetry::LinkHealth& link = *seen.link;
    RobotSummary& out = robot.out;
    if (isNew) out.link = RobotSummary::Link{};  // clang 14 refuses emplace() here
    // Colours may come late, with the referee.
    out.name = seen.name;
    out.ownName = seen.ownName;
    out.team = seen.identity.team;
    out.link->messages = link.messages;
    out.link->loss = link.loss;
    robot.present += step;
    if (link.timedOut) return;
    out.seconds += step;
    if (seen.battery && seen.battery->volts > 0.0) {
      out.link->leastVolts =
          std::min(out.link->leastVolts.value_or(seen.battery->volts), seen.battery->volts);
    }
    const bool kicking = seen.decided && isKick(*seen.decided);
    if (kicking && !robot.wasKicking) ++out.kicks;
    robot.wasKicking = kicking;
    if (seen.fallen && !robot.wasFallen) ++out.falls;
    robot.wasFallen = seen.fallen;
    for (std::size_t i = 0; i < seen.lamps.size(); ++i) {
      const telemetry::HeartbeatState state = seen.lamps[i].state;
      if (state == telemetry::HeartbeatState::Unknown) continue;
      robot.known[i] += step;
      if (state == telemetry::HeartbeatState::Working) robot.worked[i] += step;
    }
    if (!seen.poseKnown()) return;
    const Point here = seen.pose.position;
    if (!robot.anchor) robot.anchor = here;
    const double travelled = std::hypot(here.x - robot.anchor->x, here.y - robot.anchor->y);
    if (travelled >= leastMove) {
      robot.travelled += travelled;
      robot.anchor = here;
    }
    if (seen.ball && seen.ball->distance <= ballReach) {
      m_sums.hold(out, frame.snapshot.time, step);
    }
  }

  telemetry::TimeRange m_range;
  std::map<RobotKey, Robot> m_robots;
  TeamSums m_sums;
  std::map<int, HalfScores> m_halves;  // by the team's number
  MatchFrame m_last;
};

}  // namespace

void HalfScores::see(std::size_t half, int score) {
  if (!m_last && half > 0) return;
  if (m_goals.size() <= half) m_goals.resize(half + 1, 0);
  // A goal that is taken back may have been shot in an earlier half.
  m_goals[half] += score - std::exchange(m_last, score).value_or(0);
}

std::size_t TeamSums::part(double time) const {
  const double length = m_range.end - m_range.begin;
  const double share = length > 0 ? (time - m_range.begin) / length : 0.0;
  return static_cast<std::size_t>(std::clamp(share * static_cast<double>(statisticsParts), 0.0,
                                             static_cast<double>(statisticsParts - 1)));
}

void TeamSums::hold(RobotSummary& robot, double time, double seconds) {
  robot.ballSeconds += seconds;
  std::vector<double>& curve = m_held[robot.team];
  curve.resize(statisticsParts, 0.0);
  curve[part(time)] += seconds;
}

TeamSummary& TeamSums::team(TeamColor team) {
  TeamSummary& found = m_teams[team];
  found.team = team;
  return found;
}

SessionStatistics TeamSums::finish() {
  SessionStatistics out;
  out.range = m_range;
  for (const RobotSummary& robot : m_robots) {
    TeamSummary& sum = team(robot.team);
    sum.ballSeconds += robot.ballSeconds;
    sum.kicks += robot.kicks;
    sum.falls += robot.falls;
    sum.distance += robot.distance.value_or(0.0);
  }
  const double length = (m_range.end - m_range.begin) / static_cast<double>(statisticsParts);
  for (auto& [colour, team] : m_teams) {
    for (const double seconds : m_held[colour]) {
      if (length > 0) team.ballCurve.push_back(std::min(1.0, seconds / length));
    }
    out.teams.push_back(std::move(team));
  }
  out.robots = std::move(m_robots);
  std::ranges::stable_sort(out.robots, {}, &RobotSummary::order);
  std::ranges::stable_sort(out.teams, {}, [&](const TeamSummary& team) {
    return std::ranges::find(out.robots, team.team, &RobotSummary::team) - out.robots.begin();
  });
  return out;
}

SessionStatistics liveStatistics(const telemetry::SessionReader& session,
                                 telemetry::TimeRange range) {
  Walk walk(range);
  RecordedFrames frames(backdropOf(session));  // with the robots that sent variables only
  const double length = range.end - range.begin;
  const double step = std::max(shortestStep, length / mostMoments);
  const auto count = static_cast<std::uint64_t>(std::max(length, 0.0) / step);
  for (std::uint64_t i = 0; i <= count; ++i) {
    // The last one is the end itself: the score that counts may come with the last packet.
    const double time = i == count ? range.end : range.begin + step * static_cast<double>(i);
    walk.add(frames.frameAt(session, time), step);
  }
  SessionStatistics out = walk.finish(eventsOf(session));
  for (const telemetry::SessionGroup& group : session.groups()) out.rows += group.rows;
  return out;
}

}  // namespace pitchboard::link
