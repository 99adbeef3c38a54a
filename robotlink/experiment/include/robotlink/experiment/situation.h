// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A moment as a test: the scenario that starts from it, and what must hold in some runs of it. The
// file is an experiment like any other (docs/experiments.md). Plain values; any thread. Metres,
// seconds, degrees as in the file.

#include <span>
#include <string>
#include <vector>

#include <robotlink/experiment/experiment.h>
#include <robotlink/session/moment_scenario.h>

namespace pitchboard::link {

/// The moment as a scenario without the stop conditions of its match. A referee's game goes on from
/// this moment.
MomentScenario situationScenario(const MatchFrame& frame, const MomentOptions& options);

struct Situation {
  std::string name = "moment", title, description;
  Scenario scenario;
  TeamColor team = TeamColor::Blue;
  std::size_t runs = 10;
  StartSpread robots{"robots", 0.05, 0.05, 5.0}, ball{"ball", 0.02, 0.02, 0.0};
  RunStop stop;
  std::vector<std::string> assertions;
};

/// The file. Fails as experimentFromJson() does, and when nothing must hold.
Result<std::string> situationToJson(const Situation& situation);

/// Something that often must hold, and what has to end a run for it.
struct SituationTemplate {
  const char* words;      ///< "A goal is scored in at least 8 of 10 runs"
  const char* assertion;  ///< "goal_rate >= 0.8"
  bool goal = false, goalAgainst = false, ballOut = false, fell = false, stuck = false;
};
std::span<const SituationTemplate> situationTemplates();

/// s without any motion that are stuck, in a test that asks for it.
inline constexpr double situationStuck = 20.0;

/// A text as the name of an experiment: letters, digits, '-', '_' and '.'; never empty.
std::string experimentNameFrom(std::string_view text);

}  // namespace pitchboard::link
