// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How `simulate` and `record` play a match: their common options, the match that these ask for, and
// the loop that plays it to its end. Used in the program's first thread.

#include <functional>
#include <optional>
#include <string>

#include <app/robots_options.h>
#include <app/scenario_options.h>
#include <robotlink/match/match_player.h>
#include <robotlink/match/simulated_match.h>

#include "simulate_report.h"

namespace pitchboard::cli {

/// s simulated, where neither the options nor the scenario say when a match ends.
inline constexpr double defaultDuration = 60.0;

struct MatchPlayOptions {
  shared::ScenarioOptions match;
  shared::RobotsOptions robots;
  std::optional<double> duration;  ///< s
  std::string speed;               ///< "max" or a number; empty: depends on the cognition
  bool keepSpeed = false;          ///< also when team programs cannot keep up
  std::string cognition = "inline";
  std::string rules;         ///< of the referee; empty: the scenario's
  std::string robotProgram;  ///< empty: pitchboard-robot beside this program
  std::optional<int> obeyReferee;
  std::optional<int> answerReferee;
};

/// Everything above but --duration, which every command describes in its own way.
void addPlayOptions(CLI::App& command, MatchPlayOptions& options);

/// Errors name the option.
Result<link::Cognition> cognitionOf(const MatchPlayOptions& options);
/// Times real time; 0 = as fast as possible.
Result<double> speedOf(const MatchPlayOptions& options, link::Cognition cognition,
                       const link::Scenario& scenario);

/// `scenario` with the options' rules and runtimes, and with an end: --duration, else its own stop
/// conditions, else the final whistle of an automatic referee, else defaultDuration (none with
/// Cognition::None). Fails if programs of a team are to be started and cannot.
Result<link::Scenario> scenarioToPlay(Result<link::Scenario> scenario,
                                      const MatchPlayOptions& options, link::Cognition cognition);

/// Warns on stderr of settings that have no effect, and says which match on this computer it is.
Result<link::SimulatedMatch> createMatch(const link::Scenario& scenario,
                                         const MatchPlayOptions& options,
                                         link::Cognition cognition);

/// Plays until the match is over, the user interrupts it, or `goOn` says no (called after each
/// batch of ticks), and looks after the robots' processes.
Outcome playToEnd(link::MatchPlayer& player, double speed, const std::function<bool()>& goOn);

}  // namespace pitchboard::cli
