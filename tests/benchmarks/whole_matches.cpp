// SPDX-License-Identifier: GPL-3.0-or-later
// Plays whole matches with their referee, from the first READY to the final whistle, and says what
// went wrong; exit code 1 when something did. Each of the scenarios is played in turn.
//   whole_matches [COUNT=50] [MINUTES OF A HALF=10] [RULES=humanoid-2021]
//   [SCENARIOS=match]
//                 [FIRST SEED=1] [PARTICLES=500] [NOISE=realistic]

#include <chrono>
#include <cstdlib>
#include <sstream>

#include <robotlink/scenario/referee_rule_sets.h>

#include "../support/whole_match.h"

using namespace pitchboard;

namespace {

int fail(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  const auto text = [&](int i, const char* usual) { return argc > i ? argv[i] : usual; };
  const int count = std::atoi(text(1, "50"));
  const double half = 60.0 * std::atof(text(2, "10"));
  const auto rules = link::refereeRuleSet(text(3, "humanoid-2021"));
  if (!rules) return fail(rules.error());
  if (!*rules) return fail({ErrorCode::InvalidArgument, "these rules have no referee", ""});
  std::vector<std::string> names;
  std::istringstream list(text(4, "match"));
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  const int first = std::atoi(text(5, "1"));
  link::MatchOptions options;
  options.process.particles = std::atoi(text(6, "500"));
  const auto noise = link::noisePreset(text(7, "realistic"));
  if (!noise) return fail(noise.error());

  int withGoal = 0, goals = 0, bad = 0;
  double simulated = 0.0, took = 0.0;
  std::printf(
      "seed scenario score kicks set_plays drop_balls penalties longest_stuck_s "
      "simulated_s x_real_time\n");
  for (int i = 0; i < count; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i) % names.size()];
    auto scenario = link::loadScenario(name);
    if (!scenario) return fail(scenario.error());
    scenario->settings.seed = static_cast<std::uint64_t>(first + i);
    scenario->settings.noise = *noise;
    scenario->settings.referee = **rules;
    scenario->settings.referee->halfTime = half;
    scenario->settings.referee->breakTime = std::min(30.0, scenario->settings.referee->breakTime);
    auto match = link::SimulatedMatch::create(*scenario, options);
    if (!match) return fail(match.error());
    const auto begin = std::chrono::steady_clock::now();
    const link::WholeMatch m = link::playWhole(*match, 6 * half + 600);
    const double wall =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    withGoal += m.left + m.right > 0;
    goals += m.left + m.right;
    simulated += m.seconds;
    took += wall;
    std::printf("%d %s %d:%d %d %d %d %d %.0f %.0f %.0f\n", first + i, name.c_str(), m.left,
                m.right, m.kicks, m.setPlays, m.dropBalls, m.penalties, m.longestStuck, m.seconds,
                m.seconds / wall);
    std::string why;
    for (std::size_t k = 1; k < m.penaltiesOf.size(); ++k) {
      if (m.penaltiesOf[k] == 0) continue;
      why += std::string(why.empty() ? "" : ", ") + std::to_string(m.penaltiesOf[k]) + " " +
             std::string(wordsOf(static_cast<sim::PenaltyKind>(k)));
    }
    if (!why.empty()) std::printf("  penalties: %s\n", why.c_str());
    for (const std::string& one : m.wrong) std::printf("  WRONG transition: %s\n", one.c_str());
    if (!m.over) std::printf("  WRONG: no final whistle\n");
    if (m.longestStuck > 60.0) {
      std::printf("  WRONG: %s stuck for %.0f s\n", m.stuckRobot.c_str(), m.longestStuck);
    }
    bad += !m.wrong.empty() || !m.over || m.longestStuck > 60.0;
    std::fflush(stdout);
  }
  std::printf(
      "%d of %d matches with a goal, %.1f goals a match, %d matches with something wrong, "
      "%.0f x real time\n",
      withGoal, count, static_cast<double>(goals) / std::max(1, count), bad,
      simulated / std::max(1e-9, took));
  return bad > 0 || 2 * withGoal <= count ? 1 : 0;
}
