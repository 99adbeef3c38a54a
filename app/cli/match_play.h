// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the commands `simulate` and `record` share: options, creating the match, and the loop that
// plays it to its end. Main thread.

#include <functional>
#include <optional>
#include <string>

#include <app/robots_options.h>
#include <app/scenario_options.h>
#include <robotlink/match/match_player.h>
#include <robotlink/match/simulated_match.h>

#include "simulate_report.h"

namespace pitchboard::cli {

/// Simulated seconds after which a match ends if neither options nor scenario set an end.
inline constexpr double defaultDuration = 60.0;

struct MatchPlayOptions {
  shared::ScenarioOptions match;
  shared::RobotsOptions robots;
  std::optional<double> duration;  ///< s
  bool keepSpeed = false;          ///< also when team programs cannot keep up
  std::string rules;               ///< of the referee; empty: the scenario's
  std::string robotProgram;        ///< empty: pitchboard-robot beside this program
  std::optional<int> obeyReferee;
  std::optional<int> answerReferee;
};

/// Adds all options above except --duration, which each command describes itself.
void addPlayOptions(CLI::App& command, MatchPlayOptions& options);

/// Returns the speed, times real time; 0: as fast as possible.
Result<double> speedOf(const MatchPlayOptions& options, link::Cognition cognition,
                       const link::Scenario& scenario);

/// Returns the scenario with the rules and runtimes of the options and an end: --duration, or else
/// its own stop conditions, the final whistle of an automatic referee, or defaultDuration (none
/// with Cognition::None). Fails if team programs would have to be started and cannot be.
Result<link::Scenario> scenarioToPlay(Result<link::Scenario> scenario,
                                      const MatchPlayOptions& options, link::Cognition cognition);

/// Creates the match. Prints to stderr a warning about settings without effect, and the number of
/// the match on this computer.
Result<link::SimulatedMatch> createMatch(const link::Scenario& scenario,
                                         const MatchPlayOptions& options,
                                         link::Cognition cognition);

/// Plays until the match is over, the user interrupts it, or `goOn`, which is called after each
/// batch of ticks, returns false. Watches the robots' processes meanwhile.
Outcome playToEnd(link::MatchPlayer& player, double speed, const std::function<bool()>& goOn);

}  // namespace pitchboard::cli
