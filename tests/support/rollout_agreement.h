// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays the same situation with rollouts and with whole cognition, and measures how far apart what
// came of it is: the Kolmogorov-Smirnov distance of goals, ball and time to the first goal.
// Situations are moments of a match of three against three, known to a decimetre: each run begins
// in a world that is drawn round them. One thread.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <base/angles.h>
#include <base/random.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/rollout/rollout_start.h>
#include <simcore/world/published_frame.h>

#include "match_moment.h"

namespace pitchboard::tests {

inline link::Scenario agreementScenario() {
  link::Scenario scenario = link::loadScenario("match-3v3").value();
  scenario.settings.noise = link::noisePreset("realistic").value();
  scenario.settings.field = sim::fieldByName("kid-2020").value();
  const sim::RobotModel model = link::loadRobotModel("kid-size").value();
  for (link::ScenarioRobot& robot : scenario.robots) robot.model = model;
  return scenario;
}

inline std::unique_ptr<link::SimulatedMatch> agreementMatch(std::uint64_t seed) {
  link::Scenario scenario = agreementScenario();
  scenario.settings.seed = seed;
  link::MatchOptions options;
  options.process.particles = 500;
  return std::make_unique<link::SimulatedMatch>(
      link::SimulatedMatch::create(scenario, options).value());
}

/// A number of each run: goals of left minus right, ball at the end, seconds to the first goal.
struct Endings {
  std::vector<double> goals, x, y, time;
  void add(double difference, Point ball, double seconds) {
    goals.push_back(difference);
    x.push_back(ball.x);
    y.push_back(ball.y);
    time.push_back(seconds);
  }
};

/// The largest difference of the two distribution functions.
inline double kolmogorovSmirnov(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double most = 0.0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const double at = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= at) ++i;
    while (j < b.size() && b[j] <= at) ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                   static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return most;
}

struct Distances {
  double goals = 0.0, x = 0.0, y = 0.0, time = 0.0;
  std::array<double, 4> all() const { return {goals, x, y, time}; }
};

inline Distances distancesOf(const Endings& a, const Endings& b) {
  return {kolmogorovSmirnov(a.goals, b.goals), kolmogorovSmirnov(a.x, b.x),
          kolmogorovSmirnov(a.y, b.y), kolmogorovSmirnov(a.time, b.time)};
}

// How surely robots and ball are known, of each axis.
inline constexpr double placeSigma = 0.1, headingSigma = 0.05;  // m, rad

struct Situation {
  link::Moment moment;
  rollout::Belief belief;
};

inline Situation situationOf(const link::SimulatedMatch& match) {
  Situation made;
  made.moment = link::momentOf(match);

  const auto& bodies = std::get<sim::RigidBodyState>(made.moment.state.physics);
  for (const sim::RigidRobot& robot : bodies.robots) {
    rollout::RobotBelief belief;
    belief.pose = robot.pose;
    belief.sigma = placeSigma;
    belief.yawSigma = headingSigma;
    belief.forward = robot.forwardSpeed;
    belief.left = robot.sidewaysSpeed;
    belief.turn = robot.yawRate;
    belief.down = robot.posture != sim::Posture::Upright;
    belief.getsUpIn = robot.getUpRemaining;
    made.belief.robots.push_back(belief);
  }
  made.belief.ball.place = bodies.ball.position;
  made.belief.ball.velocity = bodies.ball.velocity;
  made.belief.ball.sigma = placeSigma;
  made.belief.ball.velocitySigma = 0.0;
  return made;
}

/// The ball lies on the field: only then something may come of it.
inline bool isOnField(const Situation& situation) {
  const sim::FieldSpec& field = situation.moment.state.settings.field;
  const Point& ball = situation.belief.ball.place;
  return std::abs(ball.x) < field.halfLength() - 0.3 && std::abs(ball.y) < field.halfWidth() - 0.3;
}

/// A world drawn round the moment: what robots believe stays, so that they err.
inline void spread(sim::WorldState& state) {
  auto& bodies = std::get<sim::RigidBodyState>(state.physics);
  CounterRandom random(state.settings.seed, 0, NoiseStream::Behaviour, 1);
  for (sim::RigidRobot& robot : bodies.robots) {
    robot.pose.position.x = random.normal(robot.pose.position.x, placeSigma);
    robot.pose.position.y = random.normal(robot.pose.position.y, placeSigma);
    robot.pose.yaw = wrapToPi(random.normal(robot.pose.yaw, headingSigma));
  }
  bodies.ball.position.x = random.normal(bodies.ball.position.x, placeSigma);
  bodies.ball.position.y = random.normal(bodies.ball.position.y, placeSigma);
}

/// Where a ball counts as lying that has crossed a line, however far the tick took it.
inline Point onTheLine(const sim::FieldSpec& field, Point ball) {
  return {std::clamp(ball.x, -field.halfLength(), field.halfLength()),
          std::clamp(ball.y, -field.halfWidth(), field.halfWidth())};
}

/// What robots believe of their places against where they are: sums of squares.
struct BeliefErrors {
  double places = 0.0, yaws = 0.0, count = 0.0;
  double place() const { return std::sqrt(places / (2.0 * count)); }  ///< m, of an axis
  double yaw() const { return std::sqrt(yaws / count); }              ///< rad
};

inline void addErrors(const link::SimulatedMatch& match, BeliefErrors& errors) {
  const sim::WorldState& state = match.simulation().state();
  const auto& bodies = std::get<sim::RigidBodyState>(state.physics);
  const link::RobotVariables v;
  for (std::size_t i = 0; i < bodies.robots.size(); ++i) {
    const link::Blackboard& board = *match.blackboard(state.robots[i].id);
    const Pose believed = sim::published_frame::studioFromLocalization(
        state.settings.field, {static_cast<double>(board.read(v.localizationX)),
                               static_cast<double>(board.read(v.localizationY)),
                               static_cast<double>(board.read(v.localizationTheta))});
    const Pose& truth = bodies.robots[i].pose;
    const double off = distance(believed.position, truth.position);
    const double turned = wrapToPi(believed.yaw - truth.yaw);
    if (off > 1.0) continue;  // lost
    errors.places += off * off;
    errors.yaws += turned * turned;
    errors.count += 1.0;
  }
}

inline Endings playWhole(link::SimulatedMatch& match, const Situation& situation,
                         std::uint64_t firstSeed, int runs, double seconds,
                         BeliefErrors* errors = nullptr) {
  Endings endings;
  link::Moment moment = situation.moment;
  moment.state.settings.afterGoal = sim::AfterGoal::StopClock;
  const sim::FieldSpec field = moment.state.settings.field;
  const double rate = moment.state.settings.tickRate;
  std::vector<link::MatchEvent> events;
  for (int run = 0; run < runs; ++run) {
    moment.state.settings.seed = firstSeed + static_cast<std::uint64_t>(run);
    moment.state.physics = situation.moment.state.physics;
    spread(moment.state);
    if (!match.restore(moment)) std::abort();
    const sim::Score before = moment.state.score;
    double difference = 0.0, time = seconds;
    Point ball;
    for (int tick = 1; tick <= static_cast<int>(seconds * rate); ++tick) {
      match.tick();
      const sim::WorldState& state = match.simulation().state();
      ball = std::get<sim::RigidBodyState>(state.physics).ball.position;
      difference = (state.score.left - before.left) - (state.score.right - before.right);
      const bool out = std::abs(ball.x) > field.halfLength() + field.ballRadius ||
                       std::abs(ball.y) > field.halfWidth() + field.ballRadius;
      if (difference != 0.0) time = tick / rate;
      if (difference != 0.0 || out) break;
    }
    if (errors != nullptr) addErrors(match, *errors);
    endings.add(difference, onTheLine(field, ball), time);
    match.drainEvents(events);
    events.clear();
  }
  return endings;
}

inline Endings playRollouts(rollout::Rollouts& rollouts, const sim::FieldSpec& field,
                            const Situation& situation, std::uint64_t firstSeed, int runs,
                            double seconds) {
  std::vector<std::uint64_t> seeds;
  for (int run = 0; run < runs; ++run) {
    seeds.push_back(firstSeed + static_cast<std::uint64_t>(run));
  }
  std::vector<double> out(seeds.size() * rollout::columnCount);
  if (!rollouts.play(situation.belief, seeds, {.seconds = seconds}, out)) std::abort();
  Endings endings;
  for (std::size_t row = 0; row < out.size(); row += rollout::columnCount) {
    const auto at = [&](rollout::Column column) {
      return out[row + static_cast<std::size_t>(column)];
    };
    const double time = at(rollout::Column::TimeToGoal);
    endings.add(at(rollout::Column::GoalsLeft) - at(rollout::Column::GoalsRight),
                onTheLine(field, {at(rollout::Column::BallX), at(rollout::Column::BallY)}),
                std::isnan(time) ? seconds : time);
  }
  return endings;
}

}  // namespace pitchboard::tests
