// SPDX-License-Identifier: GPL-3.0-or-later
// A whole match in lock-step: simulation, blackboards, bridge and the inline naive decision (or the
// soccer behaviours with localization, at most 500 particles) of six robots, on one core. The
// counter says how many times faster than real time it plays.

#include <benchmark/benchmark.h>

#include <robotlink/match/simulated_match.h>

namespace pitchboard::link {
namespace {

void match(benchmark::State& state, const char* name, const char* noise, bool naive) {
  Scenario scenario = loadScenario(name).value();
  scenario.settings.noise = noisePreset(noise).value();
  if (naive) {
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = "naive";
  }
  MatchOptions options;
  options.process.particles = 500;
  auto played = SimulatedMatch::create(scenario, options).value();
  for (auto _ : state) played.tick();
  state.counters["x real time"] =
      benchmark::Counter(static_cast<double>(state.iterations()) / scenario.settings.tickRate,
                         benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(match, rigid_body_no_noise, "match-3v3", "none", true)->MinTime(2.0);
BENCHMARK_CAPTURE(match, rigid_body_paper_noise, "match-3v3", "paper", true)->MinTime(2.0);
BENCHMARK_CAPTURE(match, rigid_body_realistic_noise, "match-3v3", "realistic", true)->MinTime(2.0);
BENCHMARK_CAPTURE(match, soccer_realistic_noise, "match-3v3", "realistic", false)->MinTime(2.0);
// A whole match: four a side, from kick-off on, with its referee.
BENCHMARK_CAPTURE(match, whole_4v4_realistic_noise, "match", "realistic", false)->MinTime(2.0);
BENCHMARK_CAPTURE(match, published_physics, "published-match-3v3", "published", true)->MinTime(2.0);

}  // namespace
}  // namespace pitchboard::link

BENCHMARK_MAIN();
