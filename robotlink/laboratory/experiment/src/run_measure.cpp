// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_measure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <base/nearest_name.h>
#include <base/try.h>
#include <robotlink/experiment/checks.h>
#include <robotlink/experiment/statistics.h>
#include <robotlink/report/session_tally.h>
#include <telemetry/statistics/quantile.h>

namespace pitchboard::link {
namespace {

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double still = 0.05;            // m; who moves less than this does not move
constexpr double touchTolerance = 0.005;  // m between two bodies that touch
constexpr double centimetre = 0.01;       // m

constexpr double minJump = 0.3;    // m
constexpr double maxSpeed = 20.0;  // m/s; faster than any ball

Point inCentimetres(const Point& p) {
  return {std::round(p.x * 100.0) / 100.0, std::round(p.y * 100.0) / 100.0};
}

}  // namespace

void MeanOf::add(double value) {
  if (!std::isfinite(value)) return;
  m_sum += value;
  m_last = value;
  ++m_count;
}

double MeanOf::mean() const {
  return m_count > 0 ? m_sum / static_cast<double>(m_count) : unmeasured;
}

Result<ReducedExpression> ReducedExpression::make(const ExpressionMetric& metric,
                                                  const LatestRows& rows) {
  auto expression = TRY(telemetry::Expression::parse(metric.expression));
  std::vector<LatestRows::Place> places;
  for (const std::string& variable : expression.variables()) {
    const std::size_t slash = variable.find('/');
    const auto place = rows.find(variable.substr(0, slash), variable.substr(slash + 1));
    if (!place) {
      // Expressions write B1.BELIEF_ERROR.
      const auto written = [](std::string name) {
        std::ranges::replace(name, '/', '.');
        return name;
      };
      std::vector<std::string> names = rows.names();
      for (std::string& name : names) name = written(std::move(name));
      const std::string_view near =
          nearestName(written(variable), std::vector<std::string_view>(names.begin(), names.end()));
      return failure(ErrorCode::NotFound,
                     "there is no variable " + written(variable) + " in this match; " +
                         (near.empty() ? "groups are the robots' names and \"match\""
                                       : "did you mean " + std::string(near) + "?"),
                     "metrics: " + metric.name);
    }
    places.push_back(*place);
  }
  return ReducedExpression(std::move(expression), std::move(places), metric.reduction);
}

void ReducedExpression::sample(double time, const LatestRows& rows) {
  for (std::size_t i = 0; i < m_places.size(); ++i) m_values[i] = rows.value(m_places[i]);
  const double value = m_expression.evaluate(time, m_values);
  if (!std::isfinite(value)) return;
  const bool isTrue = value != 0.0;
  m_changes += isTrue && !m_true;
  m_true = isTrue;
  if (m_count > 0) {
    m_integral += (time - m_time) * (value + m_mean.last()) / 2.0;
  } else {
    m_first = m_least = m_most = value;
  }
  m_least = std::min(m_least, value);
  m_most = std::max(m_most, value);
  m_mean.add(value);
  m_time = time;
  ++m_count;
  if (m_reduction == Reduction::P95) m_all.push_back(value);
}

double ReducedExpression::value() const {
  if (m_count == 0) return unmeasured;
  switch (m_reduction) {
    case Reduction::Mean:
      return m_mean.mean();
    case Reduction::Least:
      return m_least;
    case Reduction::Most:
      return m_most;
    case Reduction::First:
      return m_first;
    case Reduction::Last:
      return m_mean.last();
    case Reduction::Sum:
      return m_integral;
    case Reduction::Changes:
      return m_changes;
    case Reduction::P95:
      break;
  }
  std::vector<double> sorted = m_all;
  std::ranges::sort(sorted);
  return telemetry::quantile(sorted, 0.95);
}

void PathFollower::look(const Point& at, double tickTime) {
  const double reach = std::max(minJump, maxSpeed * tickTime);
  if (m_last && !m_stops.empty() && distance(*m_last, at) > reach) {
    if (distance(m_stops.back().at, *m_last) > 0.0) keep(*m_last, false);
    keep(at, true);
  }
  m_last = at;
}

void PathFollower::follow(const Point& at) {
  m_last = at;
  if (m_stops.empty() || distance(m_stops.back().at, at) >= m_step) keep(at, m_stops.empty());
}

void PathFollower::keep(const Point& at, bool begins) {
  m_stops.push_back({at, begins});
  if (m_stops.size() < maxPathPoints) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < m_stops.size(); i += 2) {
    Stop stop = m_stops[i];
    stop.begins = stop.begins || (i > 0 && m_stops[i - 1].begins);
    m_stops[kept++] = stop;
  }
  m_stops.resize(kept);
  m_step *= 2.0;
}

std::vector<RunPath> PathFollower::pieces() const {
  std::vector<RunPath> out;
  for (const Stop& stop : m_stops) {
    if (stop.begins) out.push_back({m_who, {}});
    out.back().points.push_back(inCentimetres(stop.at));
  }
  if (out.empty()) out.push_back({m_who, {}});
  const Point last = inCentimetres(m_last.value_or(Point{}));
  std::vector<Point>& points = out.back().points;
  if (points.empty() || points.back() != last) points.push_back(last);
  return out;
}

RunMeasure::RunMeasure(const Experiment& experiment, const RunPlace& run,
                       std::shared_ptr<LatestRows> rows, std::shared_ptr<const RowTally> tally)
    : m_experiment(experiment),
      m_run(run),
      m_rows(std::move(rows)),
      m_tally(std::move(tally)),
      m_team(experiment.conditions[run.condition].team) {}

void RunMeasure::begin(const SimulatedMatch& match) {
  match.simulation().snapshot(m_now);
  if (m_run.index < m_experiment.pathsShown) m_paths.emplace_back("ball");
  for (const sim::RobotSnapshot& robot : m_now.robots) {
    const std::string name = robot.identity.name();
    m_robots.push_back({name, robot.identity.team == m_team, robot.pose.position});
    if (!m_paths.empty()) m_paths.emplace_back(name);
  }
  m_touching.assign(m_robots.size() * m_robots.size(), 0);
  for (const ExpressionMetric& metric : m_experiment.metrics) {
    auto made = ReducedExpression::make(metric, *m_rows);
    if (!made) {
      m_problem = made.error();
      return;
    }
    m_expressions.push_back(std::move(*made));
  }
}

void RunMeasure::ticked(const SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) {
  if (m_robots.empty() && m_samples == 0) begin(match);
  lookForJumps(match);
  m_watch.ticked(match.simulation().state(), match.simulation().events());
  if (m_rows->samples() != m_samples) {
    m_samples = m_rows->samples();
    sample(match);
  }
  if (match.finishedBy() == "duration") end("time");
}

void RunMeasure::happened(std::span<const MatchEvent> events) {
  using Kind = MatchEventKind;
  const RunStop& stop = m_experiment.stop;
  const auto ofTeam = [&](const MatchEvent& event) {
    return std::ranges::any_of(
        m_robots, [&](const Robot& robot) { return robot.ours && robot.name == event.name; });
  };
  for (const MatchEvent& event : events) {
    if (event.kind == Kind::Goal && event.colour == m_team) {
      ++m_goals;
      if (!m_firstGoal) m_firstGoal = event.time;
      if (stop.goal) end("goal");
    } else if (event.kind == Kind::Goal) {
      ++m_goalsAgainst;
      if (stop.goalAgainst) end("goal_against");
    } else if (event.kind == Kind::BallOut) {
      ++m_ballsOut;
      if (stop.ballOut) end("ball_out");
    } else if (event.kind == Kind::Fall && ofTeam(event)) {
      m_fell = true;
      if (stop.fell) end("fell");
    }
  }
}

void RunMeasure::sample(const SimulatedMatch& match) {
  match.simulation().snapshot(m_now);
  for (ReducedExpression& expression : m_expressions) expression.sample(m_now.time, *m_rows);
  watchMovement();
  followPaths();
  countCollisions(match.simulation().state());
  m_watch.sample(match.simulation().state(), m_now);
}

void RunMeasure::watchMovement() {
  std::vector<Point>& anchors = m_anchors;
  const bool first = anchors.empty();
  std::size_t at = 0;
  bool moved = first;
  const auto look = [&](const Point& place) {
    if (first) anchors.push_back(place);
    moved = moved || distance(anchors[at], place) > still;
    ++at;
  };
  look(m_now.ball);
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    if (m_robots[i].ours) look(m_now.robots[i].pose.position);
  }
  if (moved) {
    anchors.clear();
    anchors.push_back(m_now.ball);
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      if (m_robots[i].ours) anchors.push_back(m_now.robots[i].pose.position);
    }
    m_movedAt = m_now.time;
  }
  if (m_experiment.stop.stuck && m_now.time - m_movedAt >= *m_experiment.stop.stuck) {
    m_stuck = true;
    end("stuck");
  }
}

void RunMeasure::followPaths() {
  if (m_paths.empty()) return;
  m_paths.front().follow(m_now.ball);
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    m_paths[i + 1].follow(m_now.robots[i].pose.position);
  }
}

void RunMeasure::lookForJumps(const SimulatedMatch& match) {
  if (m_paths.empty()) return;
  match.simulation().snapshot(m_now);
  const double tickTime = 1.0 / match.simulation().state().settings.tickRate;
  m_paths.front().look(m_now.ball, tickTime);
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    m_paths[i + 1].look(m_now.robots[i].pose.position, tickTime);
  }
}

void RunMeasure::countCollisions(const sim::WorldState& world) {
  const std::size_t n = m_robots.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = distance(m_now.robots[i].pose.position, m_now.robots[j].pose.position);
      const bool touches =
          apart < sim::robotRadius(world, i) + sim::robotRadius(world, j) + touchTolerance;
      char& before = m_touching[i * n + j];
      m_collisions += touches && !before && (m_robots[i].ours || m_robots[j].ours);
      before = touches;
    }
  }
}

RunMeasure::Counted RunMeasure::countedOf(const MatchStatistics& all) const {
  Counted out;
  for (const TeamSummary& team : all.teams) (team.team == m_team ? out.ours : out.others) = team;
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    if (!m_robots[i].ours) continue;
    out.displacement += distance(m_robots[i].start, m_now.robots[i].pose.position);
    const RobotSummary* robot = all.robot(m_robots[i].name);
    if (robot == nullptr || !robot->errorMean) continue;
    out.belief.add(*robot->errorMean * centimetre);
    out.beliefEnd.add(*robot->errorEnd * centimetre);
  }
  return out;
}

// Without a default: the compiler names the value that is not measured.
double RunMeasure::teamValue(TeamValue which, const Counted& counted) const {
  const TeamSummary &ours = counted.ours, &others = counted.others;
  switch (which) {
    case TeamValue::Success:  // judged when the run's values are known
      return 0.0;
    case TeamValue::Goal:
      return m_goals > 0;
    case TeamValue::GoalAgainst:
      return m_goalsAgainst > 0;
    case TeamValue::BallOut:
      return m_ballsOut > 0;
    case TeamValue::Stuck:
      return m_stuck;
    case TeamValue::Fell:
      return m_fell;
    case TeamValue::Timeout:
      return m_endedBy == "time";
    case TeamValue::Goals:
      return m_goals;
    case TeamValue::GoalsAgainst:
      return m_goalsAgainst;
    case TeamValue::Time:
      return m_now.time;
    case TeamValue::TimeToGoal:
      return m_firstGoal.value_or(unmeasured);
    case TeamValue::Walked:
      return ours.distance;
    case TeamValue::Displacement:
      return counted.displacement;
    case TeamValue::Kicks:
      return ours.kicks;
    case TeamValue::Falls:
      return ours.falls;
    case TeamValue::BallsOut:
      return m_ballsOut;
    case TeamValue::BeliefError:
      return counted.belief.mean();
    case TeamValue::BeliefErrorEnd:
      return counted.beliefEnd.mean();
    case TeamValue::Possession:
      return ours.ballSeconds + others.ballSeconds > 0.0
                 ? ours.ballSeconds / (ours.ballSeconds + others.ballSeconds)
                 : unmeasured;
    case TeamValue::Collisions:
      return m_collisions;
    case TeamValue::Penalties:
      return ours.penalties;
    case TeamValue::BallAttended:
      return m_watch.ballAttended();
    case TeamValue::SupportersClose:
      return m_watch.supportersClose();
    case TeamValue::Passes:
      return ours.plays.passes + others.plays.passes;
    case TeamValue::PassesOwn:
      return ours.plays.passes;
    case TeamValue::RemovalsTeamHalf:
      return m_watch.removalsOfTeamAndHalf();
    case TeamValue::RemovalsAgain:
      return m_watch.removedAgain();
    case TeamValue::RemovalsPushing:
      return m_watch.removalsFor(PenaltyKind::Pushing);
    case TeamValue::RemovalsIncapable:
      return m_watch.removalsFor(PenaltyKind::Incapable);
    case TeamValue::RemovalsPosition:
      return m_watch.removalsFor(PenaltyKind::IllegalPosition);
    case TeamValue::RemovalsInSet:
      return m_watch.removalsFor(PenaltyKind::MotionInSet);
    case TeamValue::RemovalsStuck:
      return m_watch.removalsFor(PenaltyKind::LocalStuck);
    case TeamValue::RemovalsLeaving:
      return m_watch.removalsFor(PenaltyKind::Leaving);
    case TeamValue::LongestStuck:
      return m_watch.maxStuck();
    case TeamValue::IllegalTransitions:
      return m_watch.illegalTransitions();
    case TeamValue::Ready:
      return m_watch.ready();
  }
  return unmeasured;
}

RunResult RunMeasure::result(const SimulatedMatch& match, std::span<const double> rules) {
  match.simulation().snapshot(m_now);
  if (match.finished()) end(match.finishedBy());
  RunResult out;
  out.number = m_run.number;
  out.seed = match.simulation().state().settings.seed;
  out.match = match.result();
  out.match.endedBy = m_endedBy;
  out.ticks = m_now.tick;
  out.hash = match.simulation().hash();

  const MatchStatistics counted = m_tally->statistics({0.0, m_now.time});
  const Counted ofTeam = countedOf(counted);
  for (std::size_t i = 0; i < teamValueCount; ++i)
    out.values.push_back(teamValue(static_cast<TeamValue>(i), ofTeam));

  for (const std::string& name : robotsOf(m_experiment)) {
    const RobotSummary* robot = counted.robot(name);
    out.values.push_back(robot ? robot->distance.value_or(unmeasured) : unmeasured);
    out.values.push_back(robot ? robot->kicks : unmeasured);
    out.values.push_back(robot && robot->errorMean ? *robot->errorMean * centimetre : unmeasured);
  }
  for (const ReducedExpression& expression : m_expressions)
    out.values.push_back(expression.value());
  out.values.insert(out.values.end(), rules.begin(), rules.end());
  for (const PathFollower& path : m_paths)
    std::ranges::move(path.pieces(), std::back_inserter(out.paths));
  return out;
}

}  // namespace pitchboard::link
