// SPDX-License-Identifier: GPL-3.0-or-later
// Robot steps a second through the C interface: worlds with one robot that the caller steers, every
// tick commanded, stepped and its percepts read, on one core. Argument: worlds at once.

#include <benchmark/benchmark.h>
#include <pitchboard_sim.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

void must(pb_status status) {
  if (status == PB_OK) return;
  std::fprintf(stderr, "error: %s\n", pb_last_error());
  std::exit(2);
}

void steps(benchmark::State& state, const char* noise, const char* physics) {
  const auto count = static_cast<std::size_t>(state.range(0));
  pb_options options;
  must(pb_options_init(&options, sizeof options));
  options.worlds = static_cast<std::int32_t>(count);
  options.noise = noise;
  options.physics = physics;
  pb_worlds* worlds = nullptr;
  must(pb_create(&options, &worlds));
  must(pb_set_behaviour(worlds, 1, "none"));
  must(pb_reset(worlds, PB_ALL, 1));
  std::vector<double> percepts(count * pb_column_count(PB_PERCEPTS));
  std::vector<std::int32_t> actions(count);
  constexpr std::int32_t walks[] = {1, 2, 8, 3, 17, 6, 1, 7};
  std::size_t tick = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) actions[i] = walks[(i + tick / 60) % std::size(walks)];
    must(pb_write_actions(worlds, actions.data(), actions.size()));
    must(pb_step(worlds, 1));
    must(pb_read(worlds, PB_PERCEPTS, percepts.data(), percepts.size()));
    benchmark::DoNotOptimize(percepts.data());
    ++tick;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  must(pb_destroy(worlds));
}
BENCHMARK_CAPTURE(steps, no_noise, "none", "rigid-body")->Arg(1)->Arg(64)->Arg(1024);
BENCHMARK_CAPTURE(steps, paper_noise, "paper", "rigid-body")->Arg(64);
BENCHMARK_CAPTURE(steps, realistic_noise, "realistic", "rigid-body")->Arg(64);
BENCHMARK_CAPTURE(steps, published_physics, "published", "published")->Arg(64);

/// A new beginning of a world whose robot the caller steers, and of one that is played inside.
void reset(benchmark::State& state, const char* behaviour) {
  pb_options options;
  must(pb_options_init(&options, sizeof options));
  pb_worlds* worlds = nullptr;
  must(pb_create(&options, &worlds));
  must(pb_set_behaviour(worlds, 1, behaviour));
  std::uint64_t seed = 0;
  for (auto _ : state) must(pb_reset(worlds, 0, ++seed));
  must(pb_destroy(worlds));
}
BENCHMARK_CAPTURE(reset, steered, "none");
BENCHMARK_CAPTURE(reset, striker, "striker");

}  // namespace

BENCHMARK_MAIN();
