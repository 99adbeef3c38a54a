// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What `simulate` and `record` print at the end of a match. Pure functions that write to stdout.

#include <array>
#include <optional>
#include <string>

#include <robotlink/match/simulated_match.h>

namespace pitchboard::cli {

struct Outcome {
  std::uint64_t ticks = 0;
  double simulatedSeconds = 0.0;
  double wallSeconds = 0.0;
  std::string finishedBy;  ///< as of SimulatedMatch, or "interrupted"
  std::string noise;       ///< name of the preset, or "custom"
};

/// How a match ended for one of its two teams.
struct TeamOutcome {
  TeamColor colour = TeamColor::Blue;
  link::Side side = link::Side::Left;  ///< of the goal that it defends at the end
  std::optional<int> number;           ///< the referee's; empty without one
  int score = 0;
  std::string name{};  ///< the scenario's; empty: it has none
};
/// The referee's teams in their order; without a referee by colour, as in TeamColor.
std::array<TeamOutcome, 2> teamOutcomes(const link::SimulatedMatch& match);
/// "Blue 0 : 4 Red". Teams of the same colour have their side behind it.
std::string scoreText(const link::SimulatedMatch& match);

/// Name of the preset with exactly these values, or "custom".
std::string noiseName(const sim::NoiseParameters& noise);

/// A line with the score and why the match ended.
void printResult(const link::SimulatedMatch& match, const Outcome& outcome);
void printSummary(const link::SimulatedMatch& match, const Outcome& outcome);
void printJson(const link::SimulatedMatch& match, const Outcome& outcome);

}  // namespace pitchboard::cli
