// SPDX-License-Identifier: GPL-3.0-or-later
// How well rollouts agree with whole cognition: 20 moments of matches, each played on many times by
// both, and once more by whole cognition with other seeds, which is the floor. Prints the table of
// docs/rollouts.md. `rollout_agreement [runs] [situations] [tick rate]`.

#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "../support/rollout_agreement.h"

namespace pitchboard::tests {
namespace {

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

int compare(int runs, int situations, double tickRate) {
  constexpr double seconds = 10.0;
  const link::Scenario scenario = agreementScenario();
  auto rollouts = rollout::Rollouts::create(link::rolloutStartOf(scenario, tickRate).setup).value();
  Distances sum, floorSum, most;
  BeliefErrors errors;
  double goalGap = 0.0;
  std::printf("| moment | goals | ball x | ball y | time to goal | floor | goals a run |\n");
  int found = 0;
  for (int i = 0; found < situations; ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    auto match = agreementMatch(seed);
    const int begin = 60 * (10 + 7 * (i % 9));
    for (int tick = 0; tick < begin; ++tick) match->tick();
    const Situation situation = situationOf(*match);
    if (!isOnField(situation)) continue;
    ++found;
    const Endings whole = playWhole(*match, situation, 1000, runs, seconds, &errors);
    const Endings again = playWhole(*match, situation, 500000, runs, seconds, &errors);
    const Endings fast =
        playRollouts(rollouts, scenario.settings.field, situation, 1000, runs, seconds);
    const Distances d = distancesOf(whole, fast), floor = distancesOf(whole, again);
    const auto largest = [](const Distances& of) { return std::ranges::max(of.all()); };
    const double gap = std::abs(meanOf(whole.goals) - meanOf(fast.goals));
    std::printf("| seed %d, %d s | %.3f | %.3f | %.3f | %.3f | %.3f | %+.2f, rollouts %+.2f |\n",
                i + 1, begin / 60, d.goals, d.x, d.y, d.time, largest(floor), meanOf(whole.goals),
                meanOf(fast.goals));
    std::fflush(stdout);
    sum = {sum.goals + d.goals, sum.x + d.x, sum.y + d.y, sum.time + d.time};
    floorSum = {floorSum.goals + floor.goals, floorSum.x + floor.x, floorSum.y + floor.y,
                floorSum.time + floor.time};
    most = {std::max(most.goals, d.goals), std::max(most.x, d.x), std::max(most.y, d.y),
            std::max(most.time, d.time)};
    goalGap += gap;
  }
  const double n = situations;
  std::printf("| mean | %.3f | %.3f | %.3f | %.3f | | gap %.3f |\n", sum.goals / n, sum.x / n,
              sum.y / n, sum.time / n, goalGap / n);
  std::printf("| floor | %.3f | %.3f | %.3f | %.3f | | |\n", floorSum.goals / n, floorSum.x / n,
              floorSum.y / n, floorSum.time / n);
  std::printf("| largest | %.3f | %.3f | %.3f | %.3f | | |\n", most.goals, most.x, most.y,
              most.time);
  std::printf("belief error of whole cognition: %.3f m an axis, %.2f degrees\n", errors.place(),
              errors.yaw() * 57.29577951308232);
  return 0;
}

}  // namespace
}  // namespace pitchboard::tests

int main(int argc, char** argv) {
  const auto number = [&](int i, double usual) { return argc > i ? std::atof(argv[i]) : usual; };
  return pitchboard::tests::compare(static_cast<int>(number(1, 300)),
                                    static_cast<int>(number(2, 20)), number(3, 20.0));
}
