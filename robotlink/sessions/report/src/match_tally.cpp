// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/match_tally.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <telemetry/statistics/quantile.h>

namespace pitchboard::link {
namespace {

constexpr double maxStep = 2.5;          // s; a longer gap between moments counts as absence
constexpr double minMove = 0.1;          // m; believed places tremble by less
constexpr double maxWalkingSpeed = 1.5;  // m/s; a belief that moves faster jumps to another place

/// The part of the curves in which this time lies.
std::size_t partOf(double time, telemetry::TimeRange range) {
  const double length = range.end - range.begin;
  const double share = length > 0 ? (time - range.begin) / length : 0.0;
  return static_cast<std::size_t>(std::clamp(share * static_cast<double>(statisticsParts), 0.0,
                                             static_cast<double>(statisticsParts - 1)));
}

}  // namespace

const RobotSummary* MatchStatistics::robot(std::string_view name) const {
  const auto found = std::ranges::find(robots, name, &RobotSummary::name);
  return found == robots.end() ? nullptr : &*found;
}

const TeamSummary* MatchStatistics::team(TeamColor team) const {
  const auto found = std::ranges::find(teams, team, &TeamSummary::team);
  return found == teams.end() ? nullptr : &*found;
}

void MatchTally::Counter::see(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return;
  if (last && *value < *last) {
    before += *last - *first;
    first = value;
  }
  if (!first) first = value;
  last = value;
}

std::uint32_t MatchTally::Robot::kickCount() const {
  return out.kicks + static_cast<std::uint32_t>(std::min(kicks.total(), 4e9));
}

void MatchTally::take(const TallyMoment& moment, bool isBefore) {
  for (const TallyRobot& robot : moment.robots) takeRobot(moment, robot, isBefore);
  for (const auto& [colour, team] : moment.teams) takeTeam(moment, colour, team, isBefore);
  if (!isBefore) {
    // The nearest robot has the ball.
    const TallyRobot* owner = nullptr;
    for (const TallyRobot& robot : moment.robots) {
      if (!robot.ballDistance || *robot.ballDistance > ballReach) continue;
      if (robot.link && robot.link->timedOut) continue;
      if (!owner || *robot.ballDistance < *owner->ballDistance) owner = &robot;
    }
    if (owner) {
      Robot& robot = m_robots.at(owner->uid);
      const double seconds = moment.time - m_lastTime.value_or(moment.time);
      if (seconds > 0.0 && seconds <= maxStep) {
        robot.out.ballSeconds += seconds;
        m_held.push_back({moment.time, seconds, owner->team});
      }
    }
  }
  m_lastTime = moment.time;
  followPlay(moment, isBefore);
}

namespace {

void takeOutage(double time, const telemetry::LinkHealth& link,
                std::vector<RobotSummary::Outage>& outages) {
  const double lastMessage = time - telemetry::secondsOf(link.age);
  const bool goesOn = !outages.empty() && !outages.back().isOver;
  if (link.timedOut && !goesOn) outages.push_back({lastMessage, time});
  if (!link.timedOut && !goesOn) return;
  outages.back().end = link.timedOut ? time : lastMessage;
  outages.back().isOver = !link.timedOut;
}

}  // namespace

void MatchTally::takeRobot(const TallyMoment& moment, const TallyRobot& seen, bool isBefore) {
  const auto [entry, isNew] = m_robots.try_emplace(seen.uid);
  Robot& robot = entry->second;
  RobotSummary& out = robot.out;
  const double since = isNew ? 0.0 : moment.time - robot.lastTime;
  const double step = since > 0.0 && since <= maxStep ? since : 0.0;
  robot.lastTime = moment.time;
  out.uid = seen.uid;
  out.name = seen.name;
  out.ownName = seen.ownName;
  out.order = seen.order;
  out.team = seen.team;  // colours may come late, with the referee
  m_hasTruth = m_hasTruth || seen.walked;
  const auto begins = [&](bool now, bool& before) {
    return now && !std::exchange(before, now) && !isBefore;
  };
  robot.wasPenalised = robot.wasPenalised && seen.penalised;
  out.penalties += begins(seen.penalised, robot.wasPenalised);
  if (seen.link) {
    if (!out.link) out.link = RobotSummary::Link{};  // clang 14 refuses emplace() here
    // What was received before is not of the range.
    if (isBefore) robot.messagesBefore = seen.link->messages;
    out.link->messages = seen.link->messages - std::min(seen.link->messages, robot.messagesBefore);
    out.link->loss = seen.link->loss;
    robot.present += step;
    takeOutage(moment.time, *seen.link, out.link->outages);
    if (seen.link->timedOut) return;
    if (seen.volts) {
      out.link->minVolts = std::min(out.link->minVolts.value_or(*seen.volts), *seen.volts);
    }
  }
  out.seconds += step;
  robot.walked.see(seen.walked);
  robot.kicks.see(seen.kicks);
  robot.falls.see(seen.falls);
  robot.wasKicking = robot.wasKicking && seen.kicking;
  robot.wasFallen = robot.wasFallen && seen.fallen;
  if (!seen.kicks) out.kicks += begins(seen.kicking, robot.wasKicking);
  if (!seen.falls) out.falls += begins(seen.fallen, robot.wasFallen);
  if (seen.beliefError && !isBefore) {
    robot.errors.emplace_back(moment.time, *seen.beliefError);
  }
  for (std::size_t i = 0; i < seen.works.size(); ++i) {
    if (!seen.works[i]) continue;
    robot.known[i] += step;
    if (*seen.works[i]) robot.worked[i] += step;
  }
  if (!seen.walked && seen.place) takeWay(seen, robot);
  takePlace(moment, seen, isBefore ? 0.0 : step, out.heat);
}

/// Of believed places, without jumps.
void MatchTally::takeWay(const TallyRobot& seen, Robot& robot) {
  const Point here = *seen.place;
  if (robot.last && here != robot.last->first) {
    const double reach =
        maxWalkingSpeed * std::max(0.0, seen.placeTime - robot.last->second) + minMove;
    if (distance(here, robot.last->first) > reach) robot.anchor = here;
  }
  robot.last = {here, seen.placeTime};
  if (!robot.anchor) robot.anchor = here;
  const double travelled = distance(here, *robot.anchor);
  if (travelled < minMove) return;
  robot.travelled += travelled;
  robot.anchor = here;
}

void MatchTally::takeTeam(const TallyMoment& moment, TeamColor colour, const TallyTeam& seen,
                          bool isBefore) {
  Team& team = m_teams[colour];
  team.out.team = colour;
  team.out.name = seen.name;
  if (seen.number) team.out.number = seen.number;
  if (!seen.score) return;
  team.out.score = seen.score;
  if (!team.firstScore) team.firstScore = seen.score;
  team.out.scored = *seen.score - *team.firstScore;
  if (isBefore || !moment.half) return;
  // Of a match that is counted from its first half on. A goal that is taken back may have been shot
  // in an earlier half.
  const std::size_t half = *moment.half;
  if (!team.lastInHalf && half > 0) return;
  if (team.out.byHalf.size() <= half) team.out.byHalf.resize(half + 1, 0);
  team.out.byHalf[half] += *seen.score - std::exchange(team.lastInHalf, seen.score).value_or(0);
}

void MatchTally::followPlay(const TallyMoment& moment, bool isBefore) {
  std::vector<RobotUid> kicked;
  for (const TallyRobot& robot : moment.robots) {
    Robot& known = m_robots.at(robot.uid);
    const std::uint32_t before = std::exchange(known.kicksBefore, known.kickCount());
    if (known.kickCount() > before) kicked.push_back(robot.uid);
  }
  m_follower.take(moment, kicked, isBefore);
}

void MatchTally::takePlace(const TallyMoment& moment, const TallyRobot& seen, double seconds,
                           HeatMap& heat) {
  if (!seen.place || seen.penalised || seconds <= 0.0) return;
  const double x = m_field.halfLength() + m_field.border, y = m_field.halfWidth() + m_field.border;
  if (heat.seconds.empty()) {
    heat.columns = static_cast<int>(std::ceil(2.0 * x / HeatMap::square));
    heat.rows = static_cast<int>(std::ceil(2.0 * y / HeatMap::square));
    heat.seconds.resize(static_cast<std::size_t>(heat.columns * heat.rows));
  }
  const auto team = moment.teams.find(seen.team);
  const bool turns = team != moment.teams.end() && !team->second.attacksRight.value_or(true);
  const double sign = turns ? -1.0 : 1.0;
  const auto index = [](double at, int most) {
    return std::clamp(static_cast<int>(std::floor(std::clamp(at, -1e3, 1e3) / HeatMap::square)), 0,
                      most - 1);
  };
  const int column = index(sign * seen.place->x + x, heat.columns);
  const int row = index(sign * seen.place->y + y, heat.rows);
  heat.seconds[static_cast<std::size_t>(row * heat.columns + column)] +=
      static_cast<float>(seconds);
}

/// Plays of robots and teams, with what robots missed.
void MatchTally::countPlays(MatchStatistics& out) const {
  out.plays = m_follower.events();
  out.goals = m_follower.goals();
  for (const RobotSummary& robot : out.robots) {
    if (!robot.link) continue;
    for (const RobotSummary::Outage& outage : robot.link->outages) {
      PlayEvent event;
      event.kind = PlayKind::Offline;
      event.outcome = outage.isOver ? PlayOutcome::None : PlayOutcome::GoesOn;
      event.time = outage.begin;
      event.end = outage.end;
      event.team = robot.team;
      event.robot = robot.uid;
      event.name = robot.name;
      out.plays.push_back(std::move(event));
    }
  }
  std::ranges::stable_sort(out.plays, {}, &PlayEvent::time);
  const auto count = [&out](RobotUid uid, auto PlayCounts::*which) {
    const auto robot = std::ranges::find(out.robots, uid, &RobotSummary::uid);
    if (robot == out.robots.end()) return;
    ++(robot->plays.*which);
    const auto team = std::ranges::find(out.teams, robot->team, &TeamSummary::team);
    if (team != out.teams.end()) ++(team->plays.*which);
  };
  for (const PlayEvent& play : out.plays) {
    if (play.kind == PlayKind::Pass && play.outcome == PlayOutcome::Completed) {
      count(play.robot, &PlayCounts::passes);
    } else if (play.kind == PlayKind::Pass && play.outcome == PlayOutcome::Intercepted) {
      count(play.robot, &PlayCounts::intercepted);
    } else if (play.kind == PlayKind::Shot) {
      count(play.robot, &PlayCounts::shots);
      if (play.outcome != PlayOutcome::Wide) count(play.robot, &PlayCounts::onTarget);
    } else if (play.kind == PlayKind::BallWon) {
      count(play.robot, &PlayCounts::wins);
      count(play.other, &PlayCounts::losses);
    }
  }
}

MatchStatistics MatchTally::statistics(telemetry::TimeRange range) const {
  MatchStatistics out;
  out.range = range;
  out.truthKnown = m_hasTruth;
  out.field = m_field;
  std::map<TeamColor, TeamSummary> teams;
  for (const auto& [colour, team] : m_teams) teams.emplace(colour, team.out);
  for (const auto& [uid, robot] : m_robots) {
    RobotSummary s = robot.out;
    if (robot.walked.last) s.distance = robot.walked.total();
    if (!s.distance && robot.anchor) s.distance = robot.travelled;
    s.kicks = robot.kickCount();
    s.falls += static_cast<std::uint32_t>(std::min(robot.falls.total(), 4e9));
    if (s.link && robot.present > 0.0) s.link->received = s.seconds / robot.present;
    for (std::size_t i = 0; i < s.uptime.size(); ++i) {
      if (robot.known[i] > 0.0) s.uptime[i] = robot.worked[i] / robot.known[i];
    }
    if (!robot.errors.empty()) {
      std::vector<double> sorted;
      std::vector<double> sums(statisticsParts);
      std::vector<std::uint32_t> counts(statisticsParts);
      double sum = 0.0;
      for (const auto& [time, error] : robot.errors) {
        sorted.push_back(error);
        sum += error;
        sums[partOf(time, range)] += error;
        ++counts[partOf(time, range)];
      }
      std::ranges::sort(sorted);
      s.errorMean = sum / static_cast<double>(sorted.size());
      s.errorMedian = telemetry::quantile(sorted, 0.5);
      s.error90 = telemetry::quantile(sorted, 0.9);
      s.errorEnd = robot.errors.back().second;
      for (std::size_t i = 0; i < statisticsParts; ++i) {
        s.errorCurve.push_back(counts[i] > 0 ? sums[i] / counts[i] : std::nan(""));
      }
    }
    TeamSummary& team = teams[s.team];
    team.team = s.team;
    team.ballSeconds += s.ballSeconds;
    team.kicks += s.kicks;
    team.falls += s.falls;
    team.penalties += s.penalties;
    team.distance += s.distance.value_or(0.0);
    out.robots.push_back(std::move(s));
  }
  const double part = (range.end - range.begin) / static_cast<double>(statisticsParts);
  for (auto& [colour, team] : teams) {
    for (const Held& held : m_held) {
      if (held.team != colour || !(part > 0.0)) continue;
      team.ballCurve.resize(statisticsParts, 0.0);
      team.ballCurve[partOf(held.time, range)] += held.seconds / part;
    }
    for (double& share : team.ballCurve) share = std::min(share, 1.0);
    out.teams.push_back(std::move(team));
  }
  std::ranges::stable_sort(out.robots, {}, &RobotSummary::order);
  std::ranges::stable_sort(out.teams, {}, [&](const TeamSummary& team) {
    return std::ranges::find(out.robots, team.team, &RobotSummary::team) - out.robots.begin();
  });
  countPlays(out);
  return out;
}

}  // namespace pitchboard::link
