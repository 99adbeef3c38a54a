// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/try.h>
#include <robotlink/experiment/statistics.h>
#include <robotlink/report/quantile.h>
#include <robotlink/report/session_statistics.h>

#include "checks.h"

namespace pitchboard::link {
namespace {

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double still = 0.05;            // m; who moves less than this does not move
constexpr double touchTolerance = 0.005;  // m between two bodies that touch
constexpr double centimetre = 0.01;       // m

constexpr std::size_t mostPoints = 400;

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
      return failure(ErrorCode::NotFound,
                     "there is no variable " + variable +
                         " in this match; groups are the robots' "
                         "names and \"match\" (docs/plots.md)",
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
  return quantile(sorted, 0.95);
}

void PathFollower::follow(const Point& at) {
  m_last = at;
  if (!m_points.empty() && distance(m_points.back(), at) < m_step) return;
  m_points.push_back(at);
  if (m_points.size() < mostPoints) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < m_points.size(); i += 2) m_points[kept++] = m_points[i];
  m_points.resize(kept);
  m_step *= 2.0;
}

std::vector<Point> PathFollower::points() const {
  std::vector<Point> out;
  for (const Point& point : m_points) out.push_back(inCentimetres(point));
  if (const Point last = inCentimetres(m_last); out.empty() || out.back() != last) {
    out.push_back(last);
  }
  return out;
}

RunMeasure::RunMeasure(const Experiment& experiment, const RunPlace& run,
                       std::shared_ptr<LatestRows> rows)
    : m_experiment(experiment),
      m_run(run),
      m_rows(std::move(rows)),
      m_team(experiment.conditions[run.condition].team),
      m_watch(m_team) {}

void RunMeasure::begin(const SimulatedMatch& match) {
  match.simulation().snapshot(m_now);
  if (m_run.index < m_experiment.pathsShown) m_paths.emplace_back("ball");
  for (const sim::RobotSnapshot& robot : m_now.robots) {
    const std::string name = robot.identity.name();
    const auto column = m_rows->find(name, "BELIEF_ERROR");
    m_robots.push_back({name,
                        robot.identity.team == m_team,
                        column.value_or(LatestRows::Place{}),
                        {},
                        robot.pose.position});
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
  const std::string_view team = info(m_team).name;
  const auto ofTeam = [&](const MatchEvent& event) {
    return std::ranges::any_of(
        m_robots, [&](const Robot& robot) { return robot.ours && robot.name == event.name; });
  };
  for (const MatchEvent& event : events) {
    if (event.kind == Kind::Goal && event.colour == team) {
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
    } else if (event.kind == Kind::Penalised && ofTeam(event)) {
      ++m_penalties;
    }
  }
}

void RunMeasure::sample(const SimulatedMatch& match) {
  match.simulation().snapshot(m_now);
  for (Robot& robot : m_robots) {
    robot.belief.add(m_rows->value(robot.beliefError) * centimetre);
  }
  for (ReducedExpression& expression : m_expressions) expression.sample(m_now.time, *m_rows);
  watchMovement();
  followPaths();
  countCollisions(match.simulation().state());
  followPossession();
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

void RunMeasure::followPossession() {
  double nearest = ballReach;
  const Robot* owner = nullptr;
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    const double away = distance(m_now.robots[i].pose.position, m_now.ball);
    if (away >= nearest) continue;
    nearest = away;
    owner = &m_robots[i];
  }
  if (!owner) return;
  m_anybodys += 1.0;
  m_ours += owner->ours;
}

RunMeasure::Sums RunMeasure::sumsOfTeam() const {
  Sums out;
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    if (!m_robots[i].ours) continue;
    const sim::RobotSnapshot& now = m_now.robots[i];
    out.walked += now.statistics.distanceWalked;
    out.displacement += distance(m_robots[i].start, now.pose.position);
    out.kicks += now.statistics.kicks;
    out.falls += now.statistics.falls;
    out.belief.add(m_robots[i].belief.mean());
    if (std::isfinite(m_robots[i].belief.mean())) out.beliefEnd.add(m_robots[i].belief.last());
  }
  return out;
}

// Without a default: the compiler names the value that is not measured.
double RunMeasure::teamValue(TeamValue which, const Sums& sums) const {
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
      return sums.walked;
    case TeamValue::Displacement:
      return sums.displacement;
    case TeamValue::Kicks:
      return sums.kicks;
    case TeamValue::Falls:
      return sums.falls;
    case TeamValue::BallsOut:
      return m_ballsOut;
    case TeamValue::BeliefError:
      return sums.belief.mean();
    case TeamValue::BeliefErrorEnd:
      return sums.beliefEnd.mean();
    case TeamValue::Possession:
      return m_anybodys > 0.0 ? m_ours / m_anybodys : unmeasured;
    case TeamValue::Collisions:
      return m_collisions;
    case TeamValue::Penalties:
      return m_penalties;
    case TeamValue::BallAttended:
      return m_watch.ballAttended();
    case TeamValue::SupportersClose:
      return m_watch.supportersClose();
    case TeamValue::Passes:
      return m_watch.passes();
    case TeamValue::PassesOwn:
      return m_watch.passesOfTeam();
    case TeamValue::RemovalsTeamHalf:
      return m_watch.removalsOfTeamAndHalf();
    case TeamValue::RemovalsAgain:
      return m_watch.removedAgain();
    case TeamValue::RemovalsPushing:
      return m_watch.removalsFor(sim::PenaltyKind::Pushing);
    case TeamValue::RemovalsIncapable:
      return m_watch.removalsFor(sim::PenaltyKind::Incapable);
    case TeamValue::RemovalsPosition:
      return m_watch.removalsFor(sim::PenaltyKind::IllegalPosition);
    case TeamValue::RemovalsInSet:
      return m_watch.removalsFor(sim::PenaltyKind::MotionInSet);
    case TeamValue::RemovalsStuck:
      return m_watch.removalsFor(sim::PenaltyKind::LocalStuck);
    case TeamValue::RemovalsLeaving:
      return m_watch.removalsFor(sim::PenaltyKind::Leaving);
    case TeamValue::LongestStuck:
      return m_watch.longestStuck();
    case TeamValue::IllegalTransitions:
      return m_watch.illegalTransitions();
    case TeamValue::Ready:
      return m_watch.ready();
  }
  return unmeasured;
}

RunResult RunMeasure::result(const SimulatedMatch& match) {
  match.simulation().snapshot(m_now);
  if (match.finished()) end(match.finishedBy());
  RunResult out;
  out.number = m_run.number;
  out.seed = match.simulation().state().settings.seed;
  out.match = match.result();
  out.match.endedBy = m_endedBy;
  out.ticks = m_now.tick;
  out.hash = match.simulation().hash();

  const Sums sums = sumsOfTeam();
  for (std::size_t i = 0; i < teamValueCount; ++i)
    out.values.push_back(teamValue(static_cast<TeamValue>(i), sums));

  for (const std::string& name : robotsOf(m_experiment)) {
    const auto robot = std::ranges::find(m_robots, name, &Robot::name);
    const bool here = robot != m_robots.end();
    const auto index = static_cast<std::size_t>(robot - m_robots.begin());
    out.values.push_back(here ? m_now.robots[index].statistics.distanceWalked : unmeasured);
    out.values.push_back(here ? double(m_now.robots[index].statistics.kicks) : unmeasured);
    out.values.push_back(here ? robot->belief.mean() : unmeasured);
  }
  for (const ReducedExpression& expression : m_expressions)
    out.values.push_back(expression.value());
  for (const PathFollower& path : m_paths) out.paths.push_back({path.who(), path.points()});
  return out;
}

}  // namespace pitchboard::link
