// SPDX-License-Identifier: GPL-3.0-or-later
// The series store: values appended a second, what a curve's query over ten million points costs,
// memory and time of sampling a played match, and samples of computed curves.

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <robotlink/session/match_sampler.h>
#include <telemetry/expression/expression.h>
#include <telemetry/series/series_store.h>

#include "frame_times.h"

namespace pitchboard::telemetry {
namespace {

GroupInfo group(int ints, int floats, int doubles) {
  GroupInfo info{"B1", {}, {}};
  const auto add = [&](int count, ColumnType type, const char* prefix) {
    for (int i = 0; i < count; ++i) {
      info.columns.push_back({prefix + std::to_string(i), type, "", "", ColumnKind::Number, {}});
    }
  };
  add(ints, ColumnType::Int32, "I");
  add(floats, ColumnType::Float32, "F");
  add(doubles, ColumnType::Float64, "D");
  return info;
}

/// Rows of 83 int and 122 float variables; `changing` of them differ from row to row.
void append(benchmark::State& state) {
  const auto changing = static_cast<std::size_t>(state.range(0));
  std::mt19937 random(1);
  std::vector<std::vector<std::uint32_t>> rows(1024, std::vector<std::uint32_t>(205, 0x3f800000));
  for (auto& row : rows) {
    for (std::size_t i = 0; i < changing; ++i)
      row[i * 205 / changing] = 0x3f000000 + random() % 0x800000;
  }
  SeriesStore store({.memoryBudget = std::size_t{300} << 20});
  const GroupId id = store.addGroup(group(83, 122, 0));
  std::size_t row = 0;
  for (auto _ : state) {
    store.append(id, {static_cast<double>(row) / 60.0, rows[row % rows.size()], {}});
    ++row;
  }
  state.counters["values/s"] = benchmark::Counter(205.0 * static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate);
}
BENCHMARK(append)->Arg(205)->Arg(40)->MinTime(2.0);

const SeriesStore& tenMillion() {
  static const auto store = [] {
    auto made = std::make_unique<SeriesStore>();
    const GroupId id = made->addGroup(group(1, 1, 1));
    std::mt19937 random(1);
    std::normal_distribution<float> step(0.0F, 1.0F);
    float walk = 0.0F;
    for (int i = 0; i < 10'000'000; ++i) {
      walk += step(random);
      const std::uint32_t words[] = {static_cast<std::uint32_t>(i / 1000),
                                     std::bit_cast<std::uint32_t>(walk)};
      const double values[] = {std::sin(i * 1e-4)};
      made->append(id, {i / 60.0, words, values});
    }
    return made;
  }();
  return *store;
}

/// Panning: every query begins elsewhere. Column 0 changes rarely, 1 is a float, 2 a double.
void buckets(benchmark::State& state) {
  const auto view = tenMillion().view(0);
  std::vector<SeriesBucket> out(1500);
  const double length = 9'900'000 / 60.0;
  double begin = 0.0;
  FrameTimes times(1e-6);
  for (auto _ : state) {
    times.begin();
    view->buckets(static_cast<std::uint32_t>(state.range(0)), {begin, begin + length}, out);
    times.end();
    begin = begin > 1600.0 ? 0.0 : begin + 7.31;
    benchmark::DoNotOptimize(out.data());
  }
  times.report(state);
}
BENCHMARK(buckets)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

void statistics(benchmark::State& state) {
  const auto view = tenMillion().view(0);
  for (auto _ : state) {
    auto found = view->statistics(1, {0.0, static_cast<double>(state.range(0)) / 60.0});
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(statistics)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond);

void view(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(tenMillion().view(0));
}
BENCHMARK(view);

/// Six robots with the soccer behaviours, localization and realistic noise.
link::SimulatedMatch soccer() {
  link::Scenario scenario = link::loadScenario("match-3v3").value();
  scenario.settings.noise = link::noisePreset("realistic").value();
  link::MatchOptions options;
  options.process.particles = 500;
  return link::SimulatedMatch::create(scenario, options).value();
}

double residentMegabytes() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// What sampling adds to a tick: 6 robots x (205 variables + truth) and the match.
void sampling(benchmark::State& state) {
  auto match = soccer();
  for (int i = 0; i < 600; ++i) match.tick();
  const auto store =
      std::make_shared<SeriesStore>(SeriesOptions{.memoryBudget = std::size_t{300} << 20});
  link::MatchSampler sampler(store);
  for (auto _ : state) {
    state.PauseTiming();
    match.tick();
    state.ResumeTiming();
    sampler.ticked(match, std::chrono::microseconds(1));
  }
}
BENCHMARK(sampling)->Iterations(20'000)->Unit(benchmark::kMicrosecond);

/// A sample of a computed curve: the expression alone.
void expression(benchmark::State& state, const char* text) {
  auto made = Expression::parse(text).value();
  std::vector<double> values(made.variables().size(), 2.0);
  double time = 0.0;
  for (auto _ : state) {
    values[0] = time += 0.01;
    benchmark::DoNotOptimize(made.evaluate(time, values));
  }
}
BENCHMARK_CAPTURE(expression, arithmetic, "B1.A * 2 + B1.B * 3 - 4");
BENCHMARK_CAPTURE(expression, distance, "hypot(B1.A - B1.B, B1.C - B1.D)");
BENCHMARK_CAPTURE(expression, condition, "B1.A == 4 ? B1.B : 0");
BENCHMARK_CAPTURE(expression, logic, "B1.A > 2 && B1.B < 3 || !B1.C");
BENCHMARK_CAPTURE(expression, powers, "B1.A ^ 2 + B1.B ^ 2");

/// An hour at 60 Hz. MB by the store's own account, and what the process grew by.
void hourOfMatch(benchmark::State& state) {
  for (auto _ : state) {
    auto match = soccer();
    const double before = residentMegabytes();
    const auto store =
        std::make_shared<SeriesStore>(SeriesOptions{.memoryBudget = std::size_t{4} << 30});
    link::MatchSampler sampler(store);
    for (int i = 0; i < 60 * 3600; ++i) {
      match.tick();
      sampler.ticked(match, std::chrono::microseconds(1));
    }
    state.counters["MB"] = static_cast<double>(store->memoryBytes()) / 1e6;
    state.counters["MB resident"] = residentMegabytes() - before;
  }
}
BENCHMARK(hourOfMatch)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace pitchboard::telemetry

BENCHMARK_MAIN();
