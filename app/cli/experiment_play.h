// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the commands `experiment`, `tournament` and `learn` share: options, playing runs into a
// folder, and printing the results. Main thread.

#include <cstddef>
#include <string>

#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/run_player.h>

#include "commands.h"

namespace pitchboard::cli {

struct PlayInto {
  std::string folder, shard, robotProgram;
  std::size_t jobs = 0;  ///< 0: as many as the processors can play
  bool resume = false, force = false, progress = false;
};

/// Adds --out, --jobs, --shard, --resume, --force, --progress and --robot-program.
void addPlayInto(CLI::App& command, PlayInto& options);
struct Shard {
  std::size_t index = 1, count = 1;
};
/// Reads "2/8". An empty text means that there is a single shard.
Result<Shard> shardFrom(const std::string& text);
/// Returns the chosen number of jobs; by default one per processor, or one per two processors with
/// team programs.
std::size_t jobsFor(const PlayInto& options, bool teamPrograms);
/// Returns the path of pitchboard-robot: `chosen`, or the one beside this program if that is empty.
std::string robotProgram(const std::string& chosen);

/// Plays the missing runs of this shard, records those that the experiment asks for, and prints the
/// results once all runs are complete. Returns 1 if an assertion fails.
Result<int> playInto(const link::Experiment& experiment, const PlayInto& options);
/// Prints the table of a tournament or the conditions, and the assertions. Returns 1 if one fails.
int printSummary(const link::Experiment& experiment, const link::ExperimentSummary& summary);
/// Prints the results of a complete folder. Returns 1 if an assertion fails.
Result<int> printResults(const link::Experiment& experiment, const link::ExperimentFolder& folder);

}  // namespace pitchboard::cli
