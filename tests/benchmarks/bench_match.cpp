// SPDX-License-Identifier: GPL-3.0-or-later
// A whole match in lock-step: simulation, blackboards, bridge and the inline naive decision of six
// robots, on one core. The counter says how many times faster than real time it plays.

#include <benchmark/benchmark.h>
#include <robotlink/simulated_match.h>

namespace pitchboard::link {
namespace {

void match(benchmark::State& state, const char* name, const char* noise) {
  Scenario scenario = loadScenario(name).value();
  scenario.settings.noise = noisePreset(noise).value();
  auto played = SimulatedMatch::create(scenario, {}).value();
  for (auto _ : state) played.tick();
  state.counters["x real time"] =
      benchmark::Counter(static_cast<double>(state.iterations()) / scenario.settings.tickRate,
                         benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(match, rigid_body_no_noise, "match-3v3", "none")->MinTime(2.0);
BENCHMARK_CAPTURE(match, rigid_body_paper_noise, "match-3v3", "paper")->MinTime(2.0);
BENCHMARK_CAPTURE(match, rigid_body_realistic_noise, "match-3v3", "realistic")->MinTime(2.0);
BENCHMARK_CAPTURE(match, published_physics, "published-match-3v3", "published")->MinTime(2.0);

}  // namespace
}  // namespace pitchboard::link

BENCHMARK_MAIN();
