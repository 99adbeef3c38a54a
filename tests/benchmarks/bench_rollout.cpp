// SPDX-License-Identifier: GPL-3.0-or-later
// How much faster than real time rollouts of three against three play, on one core, beside the same
// robots with their whole cognition in a match, measured in turns in the same run. CPU time. An
// argument is the number of rounds; the median counts.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <vector>

#include <robotlink/match/simulated_match.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/rollout/rollout_start.h>

namespace pitchboard {
namespace {

constexpr std::size_t count = 500;
constexpr double seconds = 10.0;

double secondsOf(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

link::Scenario threeAgainstThree() {
  link::Scenario scenario = link::loadScenario("match-3v3").value();
  scenario.settings.noise = link::noisePreset("realistic").value();
  scenario.settings.field = sim::fieldByName("kid-2020").value();
  const sim::RobotModel model = link::loadRobotModel("kid-size").value();
  for (link::ScenarioRobot& robot : scenario.robots) robot.model = model;
  return scenario;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

int measure(int rounds) {
  const link::Scenario scenario = threeAgainstThree();
  std::vector<std::uint64_t> seeds(count);
  std::iota(seeds.begin(), seeds.end(), std::uint64_t{1});
  std::vector<double> out(count * rollout::columnCount);
  link::MatchOptions options;
  options.process.particles = 500;
  auto match = link::SimulatedMatch::create(scenario, options).value();

  struct Way {
    double rate;
    int tile;
    std::vector<double> times;
  };
  std::vector<Way> ways{{20.0, 1, {}}, {20.0, 16, {}}, {60.0, 1, {}}};
  std::vector<double> whole;
  for (int round = 0; round < rounds; ++round) {
    for (Way& way : ways) {
      const link::RolloutStart arms = link::rolloutStartOf(scenario, way.rate);
      auto rollouts = rollout::Rollouts::create(arms.setup, {1, way.tile}).value();
      way.times.push_back(secondsOf([&] {
        (void)rollouts.play(arms.belief, seeds, {.seconds = seconds, .goOn = true}, out);
      }));
    }
    constexpr int ticks = 60 * 120;
    whole.push_back(secondsOf([&] {
                      for (int i = 0; i < ticks; ++i) match.tick();
                    }) /
                    120.0);
  }
  const double match1 = median(whole);
  std::printf("whole cognition: %.0f x real time\n", 1.0 / match1);
  for (const Way& way : ways) {
    const double time = median(way.times);
    std::printf(
        "%zu rollouts of %.0f s at %.0f Hz, tile of %d: %.3f s, %.0f x real time, %.1f x "
        "whole cognition\n",
        count, seconds, way.rate, way.tile, time, count * seconds / time,
        count * seconds / time * match1);
  }
  return 0;
}

}  // namespace
}  // namespace pitchboard

int main(int argc, char** argv) {
  return pitchboard::measure(argc > 1 ? std::max(1, std::atoi(argv[1])) : 5);
}
