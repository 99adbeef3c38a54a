// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who runs for the robots of a match, and what the match uses of the computer, as every command
// that plays one is told. Used at the start of a program, in its first thread.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include <robotlink/match/simulated_match.h>

namespace pitchboard::shared {

struct RobotsOptions {
  std::optional<int> match, keyBase;
  std::string pace = "lock-step";
  std::vector<std::string> runtimes;  ///< "own", "blue=own", "B1=program=/home/me/decide"
};

/// --match, --key-base, --pace and --runtime.
void addRobotsOptions(CLI::App& command, RobotsOptions& options);

/// Puts the runtimes into the scenario. Errors name the option.
Result<link::Scenario> withRuntimes(link::Scenario scenario, const RobotsOptions& options);

/// The rest.
void apply(const RobotsOptions& options, link::MatchOptions& match);

/// "Match 1: ..., because match 0 is played by ..."; empty for match 0.
std::string numberNotice(const link::SimulatedMatch& match);

}  // namespace pitchboard::shared
