// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the published experiment (paper-scenario-1, published physics with errors): runs a second
// of one job and of two, and how much faster two are.
// Real time; needs a machine with two idle cores.

#include <benchmark/benchmark.h>
#include <robotlink/experiment/run_player.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr std::size_t runsAtOnce = 60;

Experiment published() {
  auto experiment = loadExperiment("paper-scenario-1");
  if (!experiment) {
    std::fprintf(stderr, "error: %s\n", experiment.error().text().c_str());
    std::exit(2);
  }
  return std::move(*experiment);
}

/// s that the next runs of the second condition (with errors) take.
double seconds(const Experiment& experiment, std::size_t jobs, std::size_t first) {
  std::vector<std::size_t> numbers(runsAtOnce);
  std::iota(numbers.begin(), numbers.end(), experiment.runs + 1 + first);
  const auto begin = std::chrono::steady_clock::now();
  const auto played = playRuns(experiment, numbers, jobs, {}, [](const PlayedRun& run) {
    benchmark::DoNotOptimize(run.result.hash);
    return Result<void>();
  });
  if (!played) {
    std::fprintf(stderr, "error: %s\n", played.error().text().c_str());
    std::exit(2);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void runs(benchmark::State& state) {
  const Experiment experiment = published();
  std::size_t first = 0;
  for (auto _ : state) {
    state.SetIterationTime(seconds(experiment, static_cast<std::size_t>(state.range(0)), first));
    first = (first + runsAtOnce) % (experiment.runs - runsAtOnce);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(runsAtOnce));
}
BENCHMARK(runs)->ArgName("jobs")->Arg(1)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);

/// The same runs with one job and with two, in turn, so that what else the machine does meets both.
void twoJobsAgainstOne(benchmark::State& state) {
  const Experiment experiment = published();
  double one = 0.0, two = 0.0;
  std::size_t first = 0;
  for (auto _ : state) {
    one += seconds(experiment, 1, first);
    two += seconds(experiment, 2, first);
    first = (first + runsAtOnce) % (experiment.runs - runsAtOnce);
  }
  state.counters["ratio"] = one / two;
}
BENCHMARK(twoJobsAgainstOne)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(10.0);

}  // namespace

BENCHMARK_MAIN();
