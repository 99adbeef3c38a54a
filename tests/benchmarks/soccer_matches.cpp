// SPDX-License-Identifier: GPL-3.0-or-later
// Plays matches of the reference robots (striker, supporter and keeper in each team), in lock-step
// and as fast as possible, and prints what docs/BEHAVIOURS.md reports:
//   soccer_matches [SEEDS=50] [MINUTES=10] [NOISE=realistic] [FIRST SEED=1] [PARTICLES=500]

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "../support/measured_match.h"

using namespace pitchboard;

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 50;
  const double minutes = argc > 2 ? std::atof(argv[2]) : 10.0;
  const char* const noise = argc > 3 ? argv[3] : "realistic";
  const int first = argc > 4 ? std::atoi(argv[4]) : 1;
  link::MatchOptions options;
  options.process.particles = argc > 5 ? std::atoi(argv[5]) : 500;

  int withGoal = 0, bothScored = 0, goals = 0, contacts = 0;
  double touching = 0.0;
  std::vector<double> position, yaw;
  std::printf(
      "seed score first_goal_s kicks out walked_m touch_%% collisions error_cm error_deg "
      "x_real_time\n");
  for (int seed = first; seed < first + seeds; ++seed) {
    const auto scenario = link::soccerMatch(noise, static_cast<std::uint64_t>(seed));
    if (!scenario) {
      std::fprintf(stderr, "error: %s\n", scenario.error().text().c_str());
      return 2;
    }
    auto match = link::SimulatedMatch::create(*scenario, options);
    if (!match) {
      std::fprintf(stderr, "error: %s\n", match.error().text().c_str());
      return 2;
    }
    const auto start = std::chrono::steady_clock::now();
    const link::MatchMeasure m = link::playMatch(*match, minutes * 60);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    withGoal += m.left + m.right > 0;
    bothScored += m.left > 0 && m.right > 0;
    goals += m.left + m.right;
    contacts += m.collisions;
    touching += m.touchShare / seeds;
    position.insert(position.end(), m.positionError.begin(), m.positionError.end());
    yaw.insert(yaw.end(), m.yawError.begin(), m.yawError.end());
    std::printf("%d %d:%d %.0f %d %d %.0f %.1f %d %.1f %.1f %.0f\n", seed, m.left, m.right,
                m.firstGoal, m.kicks, m.ballOut, m.walked, 100 * m.touchShare, m.collisions,
                100 * link::quantile(m.positionError, 0.5),
                degreesFromRadians(link::quantile(m.yawError, 0.5)), minutes * 60 / took.count());
    std::fflush(stdout);
  }
  std::printf("%d of %d matches with a goal, %d with goals of both teams, %.1f goals a match\n",
              withGoal, seeds, bothScored, static_cast<double>(goals) / seeds);
  std::printf(
      "a robot touches another in %.1f %% of the time, %.0f contacts of two robots a match\n",
      100 * touching, static_cast<double>(contacts) / seeds);
  std::printf("belief: median error %.1f cm, %.1f deg; 90 %%: %.1f cm, %.1f deg\n",
              100 * link::quantile(position, 0.5), degreesFromRadians(link::quantile(yaw, 0.5)),
              100 * link::quantile(position, 0.9), degreesFromRadians(link::quantile(yaw, 0.9)));
  return 0;
}
