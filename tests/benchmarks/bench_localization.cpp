// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one update of the particle filter with a fixed number of particles, all four corners
// seen, resampling in every update: the worst case. The published filter makes 1.9 to 2.8 updates a
// second with 5000 particles (system.md section 10).

#include <benchmark/benchmark.h>

#include <cmath>

#include "localization/monte_carlo_localization.h"

namespace pitchboard::link {
namespace {

void update(benchmark::State& state) {
  LocalizationParameters parameters;
  parameters.minParticles = parameters.maxParticles = static_cast<int>(state.range(0));
  parameters.resampleAlways = true;
  auto filter = MonteCarloLocalization::create(sim::FieldSpec{}, parameters).value();
  LocalizationInput input;
  input.inMotion = true;
  input.imuYaw = 0.0;
  const double corners[4][2] = {{-4.5, 3}, {4.5, 3}, {-4.5, -3}, {4.5, -3}};
  for (std::size_t i = 0; i < 4; ++i) input.corners[i] = std::atan2(corners[i][1], corners[i][0]);
  for (auto _ : state) {
    filter.update(input);
    benchmark::DoNotOptimize(filter.belief());
  }
}
BENCHMARK(update)
    ->Name("localization/particles")
    ->Arg(200)
    ->Arg(500)
    ->Arg(5000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace pitchboard::link

BENCHMARK_MAIN();
