// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How `experiment`, `tournament` and `learn` play their runs into a folder: the options that they
// have in common, the playing, and what they print at the end. Used in the program's first thread.

#include <cstddef>
#include <string>

#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/run_player.h>

#include "commands.h"

namespace pitchboard::cli {

struct PlayInto {
  std::string folder, shard, robotProgram;
  std::size_t jobs = 0;  ///< 0: as many as the processors can play
  bool resume = false, progress = false;
};

/// --out, --jobs, --shard, --resume, --progress and --robot-program.
void addPlayInto(CLI::App& command, PlayInto& options);
struct Shard {
  std::size_t index = 1, count = 1;
};
/// Of "2/8"; the only one of an empty text.
Result<Shard> shardFrom(const std::string& text);
/// The chosen number, else one per processor, or per two with a team's own programs.
std::size_t jobsFor(const PlayInto& options, bool teamPrograms);
/// pitchboard-robot, if `chosen` is empty that beside this program.
std::string robotProgram(const std::string& chosen);

/// Plays the runs of this shard that are not there yet, records those that are to be recorded, and
/// prints the results once all are there. 1 if an assertion fails.
Result<int> playInto(const link::Experiment& experiment, const PlayInto& options);
/// Prints a table or conditions, and assertions. 1 if one fails.
int printSummary(const link::Experiment& experiment, const link::ExperimentSummary& summary);
/// Prints the results of a complete folder. 1 if an assertion fails.
Result<int> printResults(const link::Experiment& experiment, const link::ExperimentFolder& folder);

}  // namespace pitchboard::cli
