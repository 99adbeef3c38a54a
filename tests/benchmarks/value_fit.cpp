// SPDX-License-Identifier: GPL-3.0-or-later
// Where the numbers of the advisor's value of a position come from (position_value.cpp): least
// squares over the goal difference of the next 30 s, up to the first goal or until the ball is out,
// in rollouts of random situations of four against four. Prints the numbers and how much of the
// variance they explain. `value_fit [situations] [rollouts of each] [seed]`.

#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>

#include <Eigen/Dense>

#include <base/random.h>
#include <robotlink/capi/rollout_rows.h>

#include "position_value.h"

namespace pitchboard {
namespace {

constexpr double seconds = 30.0;
constexpr int features = 4;

using Features = Eigen::Matrix<double, features, 1>;

/// Of a ball that lies still; the order of `ofPlace`, `ofDepth`, `ofWide`, `ofBall`.
Features featuresOf(const sim::FieldSpec& field, const link::Position& at) {
  constexpr double most = 1.5;  // m
  const double x = at.ball.x / field.halfLength(), y = at.ball.y / field.halfWidth();
  return {x, x * x * x, x * y * y, std::clamp(at.theirsNear - at.near, -most, most) / most};
}

/// Everybody anywhere, keepers in their goals; `at` says what of it counts.
rollout::Belief drawn(const rollout::Setup& setup, rollout::Belief belief, std::uint64_t seed,
                      link::Position& at) {
  const sim::FieldSpec& field = setup.field;
  CounterRandom random(seed, 0, NoiseStream::Behaviour, 0);
  const auto anywhere = [&] {
    const double x = random.uniform() * 2.0 - 1.0, y = random.uniform() * 2.0 - 1.0;
    return Point{0.97 * x * field.halfLength(), 0.97 * y * field.halfWidth()};
  };
  at.ball = anywhere();
  belief.ball = {};
  belief.ball.place = at.ball;
  belief.ball.sigma = belief.ball.velocitySigma = 0.0;
  for (std::size_t i = 0; i < setup.players.size(); ++i) {
    const bool isOwn = setup.players[i].side == rollout::Side::Left;
    rollout::RobotBelief& robot = belief.robots[i];
    robot = {};
    robot.pose.position = anywhere();
    robot.pose.yaw = std::numbers::pi * (2.0 * random.uniform() - 1.0);
    if (setup.players[i].behaviour.name == "keeper") {
      robot.pose = {{(isOwn ? -1.0 : 1.0) * (field.halfLength() - 0.4), 0.0},
                    isOwn ? 0.0 : std::numbers::pi};
    }
    double& least = isOwn ? at.near : at.theirsNear;
    least = std::min(least, distance(robot.pose.position, at.ball));
  }
  return belief;
}

void fit(int situations, int runs, std::uint64_t seed) {
  const link::Scenario scenario = link::loadScenario("match").value();
  const link::RolloutStart start = link::rolloutStartOf(scenario);
  auto rollouts = rollout::Rollouts::create(start.setup).value();
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(runs));
  std::iota(seeds.begin(), seeds.end(), std::uint64_t{1});
  std::vector<double> out(seeds.size() * rollout::columnCount);
  Eigen::Matrix<double, features, features> squares;
  Features products;
  squares.setZero();
  products.setZero();
  std::vector<Features> all;
  std::vector<double> means, used;
  for (int i = 0; i < situations; ++i) {
    link::Position at;
    const auto belief = drawn(start.setup, start.belief, seed + static_cast<std::uint64_t>(i), at);
    if (!rollouts.play(belief, seeds, {.seconds = seconds}, out)) std::abort();
    double mean = 0.0;
    for (std::size_t row = 0; row < out.size(); row += rollout::columnCount) {
      mean += (out[row + static_cast<std::size_t>(rollout::Column::GoalsLeft)] -
               out[row + static_cast<std::size_t>(rollout::Column::GoalsRight)]) /
              runs;
    }
    all.push_back(featuresOf(start.setup.field, at));
    means.push_back(mean);
    used.push_back(link::positionValue(start.setup.field, at));
    squares += all.back() * all.back().transpose();
    products += mean * all.back();
  }
  const Features found = squares.ldlt().solve(products);
  double left = 0.0, leftOfUsed = 0.0, total = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double error = means[i] - found.dot(all[i]), ofUsed = means[i] - used[i];
    left += error * error;
    leftOfUsed += ofUsed * ofUsed;
    total += means[i] * means[i];
  }
  std::printf("%d situations of %d rollouts: place %.3f, depth %.3f, wide %.3f, ball %.3f\n",
              situations, runs, found[0], found[1], found[2], found[3]);
  std::printf("variance of the means explained: %.2f; by the numbers in use: %.2f\n",
              1.0 - left / total, 1.0 - leftOfUsed / total);
}

}  // namespace
}  // namespace pitchboard

int main(int argc, char** argv) {
  const auto number = [&](int i, int usual) { return argc > i ? std::atoi(argv[i]) : usual; };
  pitchboard::fit(number(1, 400), number(2, 40), static_cast<std::uint64_t>(number(3, 1)));
}
