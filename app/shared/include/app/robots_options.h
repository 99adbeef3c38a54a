// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options of all commands that play a match: the programs of its robots, its speed, and the number,
// blackboard keys and pace of the match. Used at the start of a program, on its main thread.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include <robotlink/match/simulated_match.h>

namespace pitchboard::shared {

struct RobotsOptions {
  std::string cognition = "inline";
  std::string speed;  ///< "max" or a number; empty: depends on the program and the match
  std::optional<int> match, keyBase;
  std::string pace = "lock-step";
  std::vector<std::string> runtimes;  ///< "own", "blue=own", "B1=program=/home/me/decide"
};

/// Adds the options. The default of the cognition is that of `options`.
void addRobotsOptions(CLI::App& command, RobotsOptions& options);

link::Cognition cognitionOf(const RobotsOptions& options);

/// Applies the runtimes to the scenario. Errors name the option.
Result<link::Scenario> withRuntimes(link::Scenario scenario, const RobotsOptions& options);

/// Applies the other options to the match.
void apply(const RobotsOptions& options, link::MatchOptions& match);

/// Returns "Match 1: ..., because match 0 is played by ..."; empty for match 0.
std::string numberNotice(const link::SimulatedMatch& match);

}  // namespace pitchboard::shared
