// SPDX-License-Identifier: GPL-3.0-or-later
// Robot steps a second through the C interface: worlds with one robot that the caller steers, every
// tick commanded, stepped and its percepts read, on one core. Argument: worlds at once. Growth with
// their number shows in one process only, because there each number finds the heap as the smaller
// ones left it.

#include <benchmark/benchmark.h>
#include <pitchboard_sim.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

namespace {

void must(pb_status status) {
  if (status == PB_OK) return;
  std::fprintf(stderr, "error: %s\n", pb_last_error());
  std::exit(2);
}

void steps(benchmark::State& state, const char* noise, const char* physics,
           std::int32_t threads = 1) {
  const auto count = static_cast<std::size_t>(state.range(0));
  pb_options options;
  must(pb_options_init(&options, sizeof options));
  options.worlds = static_cast<std::int32_t>(count);
  options.threads = threads;
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
BENCHMARK_CAPTURE(steps, no_noise, "none", "rigid-body")->Arg(1)->Arg(64)->Arg(1024)->Arg(4096);
BENCHMARK_CAPTURE(steps, two_threads, "none", "rigid-body", 2)
    ->Arg(16)
    ->Arg(64)
    ->Arg(256)
    ->Arg(1024)
    ->UseRealTime();
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

/// What a step of pitchboard.Worlds does in Python, with the rule of docs/python.md: read, decide,
/// command, six ticks, rewards, new beginnings. tests/benchmarks/python_worlds.py plays the same.
class Learning {
 public:
  static constexpr std::size_t count = 256;

  Learning() {
    pb_options options;
    must(pb_options_init(&options, sizeof options));
    options.text =
        R"({"version": 1, "name": "scoring", "ball": {"x": 3, "y": 0}, "robots": [{"team": "blue",
            "number": 1, "x": -1, "y": 0, "heading": 0, "behaviour": "none"}],
            "stop": {"duration": 20, "goal": true, "ball_out": true}})";
    options.noise = "paper";
    options.worlds = static_cast<std::int32_t>(count);
    must(pb_create(&options, &m_worlds));
    must(pb_set_behaviour(m_worlds, 1, "none"));
    constexpr const char* names[] = {"VISION_LOST", "VISION_BALL_DIST", "VISION_BALL_ANGLE",
                                     "IMU_EULER_Z", "CONTROL_ACTION"};
    for (std::size_t i = 0; i < variables; ++i) must(pb_find_variable(names[i], &m_variables[i]));
    for (std::size_t i = 0; i < count; ++i) m_over.push_back(static_cast<std::int32_t>(i));
    begin();
  }
  ~Learning() { must(pb_destroy(m_worlds)); }
  Learning(const Learning&) = delete;
  Learning& operator=(const Learning&) = delete;

  double step() {
    std::vector<std::int32_t> actions(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double* seen = &m_seen[i * variables];
      actions[i] = seen[0] > 0 || seen[2] > 12 ? 2 : seen[2] < -12 ? 3 : seen[1] < 22 ? 4 : 1;
    }
    must(pb_write_actions(m_worlds, actions.data(), count));
    must(pb_step(m_worlds, 6));
    std::swap(m_game, m_before);
    look();
    double rewards = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double* now = &m_game[i * m_columns];
      const double* before = &m_before[i * m_columns];
      const double scored = (now[4] - before[4]) - (now[5] - before[5]);
      rewards += scored != 0.0 ? 10.0 * scored : now[6] - before[6];
      if (now[10] != 0.0) m_over.push_back(static_cast<std::int32_t>(i));
    }
    if (!m_over.empty()) begin();
    return rewards;
  }

 private:
  static constexpr std::size_t variables = 5;

  void look() {
    must(pb_read_variables(m_worlds, m_variables, variables, m_seen.data(), m_seen.size()));
    must(pb_read(m_worlds, PB_GAME, m_game.data(), m_game.size()));
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(m_random);
  }
  void begin() {
    std::vector<std::uint64_t> seeds;
    std::vector<double> balls, poses, lost(count, std::nan(""));
    for (const std::int32_t world : m_over) {
      const double x = between(2.5, 3.5), y = between(-1.0, 1.0);
      seeds.push_back(++m_seed);
      balls.insert(balls.end(), {x, y, 0.0, 0.0});
      poses.insert(poses.end(),
                   {x - between(0.5, 2.0), y + between(-0.5, 0.5), between(-0.5, 0.5)});
      lost[static_cast<std::size_t>(world)] = 1.0;
    }
    must(pb_reset_some(m_worlds, m_over.data(), seeds.data(), seeds.size()));
    must(pb_place_balls(m_worlds, m_over.data(), seeds.size(), balls.data()));
    must(pb_place_robots(m_worlds, m_over.data(), seeds.size(), 1, poses.data()));
    must(pb_write_variables(m_worlds, m_variables, 1, lost.data(), lost.size()));
    look();
    m_over.clear();
  }

  pb_worlds* m_worlds = nullptr;
  const std::size_t m_columns = pb_column_count(PB_GAME);
  std::int32_t m_variables[variables]{};
  std::vector<double> m_seen = std::vector<double>(count * variables);
  std::vector<double> m_game = std::vector<double>(count * m_columns), m_before = m_game;
  std::vector<std::int32_t> m_over;
  std::uint64_t m_seed = 0;
  std::mt19937_64 m_random;
};

void learning(benchmark::State& state) {
  Learning learner;
  for (auto _ : state) benchmark::DoNotOptimize(learner.step());
}
BENCHMARK(learning)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
