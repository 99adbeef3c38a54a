// SPDX-License-Identifier: GPL-3.0-or-later
// How many passes and shots a tally finds, and how many it invents, in simulated matches whose
// truth is known. Prints the table of docs/statistics.md.
// `play_proof [matches] [seconds] [first seed] [scenario ...]`. The limits of the tally were chosen
// with the seeds from 1 on; without arguments others are played.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "../support/play_truth.h"

namespace pitchboard::link {
namespace {

void add(const PlayScore& one, PlayScore& sum) {
  sum.truth += one.truth;
  sum.found += one.found;
  sum.invented += one.invented;
}

void add(const PlayScores& one, PlayScores& sum) {
  add(one.completed, sum.completed);
  add(one.intercepted, sum.intercepted);
  add(one.shots, sum.shots);
  sum.onBorder += one.onBorder;
}

void print(const char* name, const PlayScores& s) {
  const auto line = [name](const char* kind, const PlayScore& one) {
    std::printf("| %s | %s | %d | %.1f %% | %.1f %% |\n", name, kind, one.truth,
                100.0 * one.foundShare(), 100.0 * one.inventedShare());
  };
  line("passes", s.completed);
  line("intercepted", s.intercepted);
  line("shots", s.shots);
}

int prove(int matches, double seconds, int firstSeed, const std::vector<std::string>& scenarios) {
  PlayScores counters, places, beliefs;
  for (int i = 0; i < matches; ++i) {
    Scenario scenario =
        loadScenario(scenarios[static_cast<std::size_t>(i) % scenarios.size()]).value();
    scenario.settings.seed = static_cast<std::uint64_t>(firstSeed + i);
    auto match = SimulatedMatch::create(scenario, {}).value();
    const PlayTrial trial(match, seconds);
    add(trial.withCounters, counters);
    add(trial.withPlaces, places);
    add(trial.withBeliefs, beliefs);
  }
  std::printf("| from | what | true | found | invented |\n|---|---|---|---|---|\n");
  print("recording of a simulation", counters);
  print("places alone", places);
  print("beliefs of robots", beliefs);
  std::printf("On the border of a definition, and counted neither way: %d\n", counters.onBorder);
  return 0;
}

}  // namespace
}  // namespace pitchboard::link

int main(int argc, char** argv) {
  using namespace pitchboard::link;
  if (std::getenv("PLAY_PROOF_TELL")) PlayTrial::tell = "";
  std::vector<std::string> scenarios(argv + std::min(argc, 4), argv + argc);
  if (scenarios.empty()) scenarios = {"match", "match-3v3", "match", "match-3v3", "match-3v3"};
  return prove(argc > 1 ? std::atoi(argv[1]) : 20, argc > 2 ? std::atof(argv[2]) : 1200.0,
               argc > 3 ? std::atoi(argv[3]) : 1001, scenarios);
}
