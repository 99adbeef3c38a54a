// SPDX-License-Identifier: GPL-3.0-or-later
// Ticks per second of the `published` model, no drawing, no cognition: every robot walks, turns or
// walks round, chosen again every 100 ticks, and searches the ball. The published implementation
// makes 10 300, 2 250 and 390 frames/s with 1, 6 and 22 robots (system.md section 10).

#include <benchmark/benchmark.h>

#include <array>

#include <simcore/simulation/simulation.h>

namespace pitchboard::sim {
namespace {

void ticks(benchmark::State& state) {
  SimulationSettings settings;
  settings.physics = "published";
  auto simulation = Simulation::create(settings).value();
  const auto count = static_cast<std::size_t>(state.range(0));
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<int>(i) + 1;
    const bool left = i % 2 == 0;
    const Pose pose{{(left ? -1.0 : 1.0) * (0.5 + 0.35 * static_cast<double>(i / 2)),
                     static_cast<double>(i % 5) - 2.0},
                    left ? 0.0 : 3.14};
    (void)simulation.addRobot(
        {RobotId{number}, left ? TeamColor::Blue : TeamColor::Red, number, !left}, pose);
  }
  std::vector<RobotCommand> commands(count);
  std::vector<Percepts> percepts(count);
  constexpr std::array<int, 6> walks{1, 2, 8, 6, 3, 9};
  std::size_t tick = 0;
  for (auto _ : state) {
    if (tick % 100 == 0) {
      for (std::size_t i = 0; i < count; ++i) {
        commands[i].actionA = walks[(i + tick / 100) % walks.size()];
        commands[i].actionB = 20;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (percepts[i].searchOn) commands[i].searchOn = *percepts[i].searchOn;
      if (percepts[i].ball.lost == 1) commands[i].searchOn = 1;
    }
    simulation.step(commands, percepts);
    ++tick;
  }
  state.counters["ticks/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["published frames/s"] = count == 1 ? 10300 : count == 6 ? 2250 : 390;
  state.counters["ratio"] =
      benchmark::Counter(static_cast<double>(state.iterations()) / (count == 1   ? 10300.0
                                                                    : count == 6 ? 2250.0
                                                                                 : 390.0),
                         benchmark::Counter::kIsRate);
}
BENCHMARK(ticks)->Name("published/robots")->Arg(1)->Arg(6)->Arg(22);

}  // namespace
}  // namespace pitchboard::sim

BENCHMARK_MAIN();
