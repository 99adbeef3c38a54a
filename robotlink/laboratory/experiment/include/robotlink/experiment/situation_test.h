// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Turns a moment of a match into a situation test: a scenario that starts from it, with assertions
// that must hold when it is played some times. The file is an experiment like any other
// (docs/experiments.md). Plain values; any thread. Metres, seconds; degrees as in the file.

#include <span>
#include <string>
#include <vector>

#include <robotlink/experiment/experiment.h>
#include <robotlink/session/moment_scenario.h>

namespace pitchboard::link {

/// Returns the moment as a scenario, without the stop conditions of its match. A refereed game
/// continues from this moment.
MomentScenario situationScenario(const MatchFrame& frame, const MomentOptions& options);

struct SituationTest {
  std::string name = "moment", title, description;
  Scenario scenario;
  TeamColor team = TeamColor::Blue;
  std::size_t runs = 10;
  StartSpread robots{"robots", 0.05, 0.05, 5.0}, ball{"ball", 0.02, 0.02, 0.0};
  RunStop stop;
  std::vector<std::string> assertions;
};

/// Returns the test as a file. Fails as experimentFromJson() does, and if there is no assertion.
Result<std::string> situationToJson(const SituationTest& situation);

/// A common assertion, and the stop conditions that it needs.
struct SituationTemplate {
  const char* text;       ///< "A goal is scored in at least 8 of 10 runs"
  const char* assertion;  ///< "goal_rate >= 0.8"
  bool goal = false, goalAgainst = false, ballOut = false, fell = false, stuck = false;
};
std::span<const SituationTemplate> situationTemplates();

/// Seconds without motion after which a run counts as stuck.
inline constexpr double situationStuck = 20.0;

/// Makes a name for an experiment from any text: letters, digits, '-', '_' and '.'; never empty.
std::string experimentNameFrom(std::string_view text);

}  // namespace pitchboard::link
