// SPDX-License-Identifier: GPL-3.0-or-later
// What robots' processes cost as separate programs (docs/performance.md):
//   bench_processes [SECONDS=10]   how long each of five measurements takes, on the wall
// In lock-step: 3 against 3, as fast as possible; the match waits for every process in every tick.
// Running freely: 11 against 11 at 60 ticks a second, CPU time of the match and all processes.
// Both once with all reference processes and once with the naive behaviour (decision and
// communication only). The best of the measurements counts: other programs may want the cores.

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <robotlink/match/simulated_match.h>

#include "../support/segment_keys.h"

using namespace pitchboard;
using namespace pitchboard::link;
using Steady = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

namespace {

constexpr int measurements = 5;
constexpr double tickRate = 60.0;

double ownCpu() {
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

/// s, of the match and of its processes so far.
double allCpu(const SimulatedMatch& match) {
  double sum = ownCpu();
  for (const ProcessStatus& one : match.robots().processes().statuses()) {
    if (one.pid == 0) continue;
    const std::string file = "/proc/" + std::to_string(one.pid) + "/schedstat";
    if (std::FILE* schedule = std::fopen(file.c_str(), "r")) {
      unsigned long long nanoseconds = 0;
      if (std::fscanf(schedule, "%llu", &nanoseconds) == 1)
        sum += static_cast<double>(nanoseconds) * 1e-9;
      std::fclose(schedule);
    }
  }
  return sum;
}

Result<SimulatedMatch> start(const char* scenarioName, const char* behaviour, RobotsPace pace) {
  auto scenario = loadScenario(scenarioName);
  if (!scenario) return tl::unexpected(scenario.error());
  for (ScenarioRobot& robot : scenario->robots) {
    if (*behaviour != '\0') robot.behaviour = behaviour;
  }
  scenario->stop = {};
  MatchOptions options;
  options.cognition = Cognition::Separate;
  options.keyBase = testKeyBase();
  options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  options.process.particles = 500;
  options.pace = pace;
  return SimulatedMatch::create(*scenario, options);
}

void measure(const char* title, const char* scenario, const char* behaviour, bool lockStep,
             double seconds) {
  auto match = start(scenario, behaviour, lockStep ? RobotsPace::LockStep : RobotsPace::Free);
  if (!match) {
    std::fprintf(stderr, "error: %s\n", match.error().text().c_str());
    std::exit(2);
  }
  match->pace().setPlaying(lockStep ? 0.0 : 1.0, false, Steady::now());
  const auto tick = std::chrono::duration_cast<Steady::duration>(Seconds(1.0 / tickRate));
  double fastest = 0.0, minCpu = 1e9, minPerTick = 1e9;
  for (int i = -1; i < measurements; ++i) {  // the first one starts the processes
    const auto begin = Steady::now();
    auto looked = begin, next = begin;
    const double cpu = allCpu(*match);
    int ticks = 0;
    while (Steady::now() - begin < Seconds(seconds)) {
      match->tick();
      ++ticks;
      const auto now = Steady::now();
      if (now - looked > std::chrono::milliseconds(50)) {
        match->pace().lookAfterProcesses(now);
        looked = now;
      }
      if (!lockStep) std::this_thread::sleep_until(next += tick);
    }
    if (i < 0) continue;
    const double passed = Seconds(Steady::now() - begin).count();
    const double spent = allCpu(*match) - cpu;
    fastest = std::max(fastest, ticks / tickRate / passed);
    minCpu = std::min(minCpu, spent / passed);
    minPerTick = std::min(minPerTick, spent / ticks);
  }
  std::printf("%-44s %3zu processes  %6.1f x real time  %5.1f %% of a core  %6.0f us CPU a tick\n",
              title, match->robots().processes().statuses().size(), fastest, 100 * minCpu,
              1e6 * minPerTick);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  if (!(seconds > 0.0)) {
    std::fprintf(stderr, "error: bench_processes [SECONDS], for example bench_processes 10\n");
    return 2;
  }
  measure("3 against 3, lock-step, all processes", "match-3v3", "", true, seconds);
  measure("3 against 3, lock-step, naive", "match-3v3", "naive", true, seconds);
  measure("11 against 11, free, all processes", "match-11v11", "", false, seconds);
  measure("11 against 11, free, naive", "match-11v11", "naive", false, seconds);
  return 0;
}
