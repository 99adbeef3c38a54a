// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What `simulate` and `record` print at the end of a match. Pure functions that write to stdout.

#include <cstdint>
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

/// Name of the preset with exactly these values, or "custom".
std::string noiseName(const sim::NoiseParameters& noise);

/// A line with the score and why the match ended.
void printResult(const link::SimulatedMatch& match, const Outcome& outcome);
void printSummary(const link::SimulatedMatch& match, const Outcome& outcome);
void printJson(const link::SimulatedMatch& match, const Outcome& outcome);

}  // namespace pitchboard::cli
