// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Prints what `simulate` and `record` show at the end of a match, to stdout. Main thread.

#include <cstdint>
#include <map>
#include <string>

#include <robotlink/match/simulated_match.h>

namespace pitchboard::cli {

struct Outcome {
  std::uint64_t ticks = 0;
  double simulatedSeconds = 0.0;
  double wallSeconds = 0.0;
  std::string finishedBy;  ///< SimulatedMatch::finishedBy(), or "interrupted"
  std::string noise;       ///< name of the preset, or "custom"
  std::map<RobotId, sim::RobotStatistics> before;  ///< what robots had done when it began
};

/// Returns the name of the preset with exactly these values, or "custom".
std::string noiseName(const sim::NoiseParameters& noise);

/// Prints a line with the score and why the match ended.
void printResult(const link::SimulatedMatch& match, const Outcome& outcome);
/// Returns whether a program of a robot died again and again, or has died and does not run.
bool keepsDying(const link::SimulatedMatch& match);
void printSummary(const link::SimulatedMatch& match, const Outcome& outcome);
void printJson(const link::SimulatedMatch& match, const Outcome& outcome);

}  // namespace pitchboard::cli
