// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The options that choose sessions and a part of them, the same for every command that reads them.
// Main thread.

#include <optional>
#include <string>
#include <vector>

#include <telemetry/query/find_moments.h>
#include <telemetry/session/session_reader.h>

#include "commands.h"

namespace pitchboard::cli {

/// What was typed for --from, --until and --clock.
struct PartOptions {
  std::string from, until;
  bool clock = false;
};
/// Adds the options. `clockNote` continues the description of --clock.
void addPart(CLI::App& command, PartOptions& options, const std::string& clockNote = {});

/// A part of a session (s); what was not given is empty.
struct Part {
  std::optional<double> from, until;
};
/// Fails with InvalidArgument, which names the option.
Result<Part> partOf(const telemetry::SessionReader& session, const PartOptions& options);

/// --jobs and --progress, of commands that read many recordings.
void addReading(CLI::App& command, int& jobs, bool& progress);

/// Adds --robots and --variables, lists with commas.
void addRobots(CLI::App& command, std::vector<std::string>& robots, const char* description);
void addVariables(CLI::App& command, std::vector<std::string>& variables, const char* description);

/// Returns the recordings (*.mcap) that are meant: files, and those in folders and the folders in
/// them, in order of their names.
Result<std::vector<std::string>> recordingsOf(const std::vector<std::string>& places);

/// Prints what could not be read of a recording, behind `fresh` (Progress::fresh()). Returns false
/// if it is unreadable, at least in part.
bool reportReading(const std::string& file, const telemetry::FileMoments& found,
                   const std::string& fresh);

}  // namespace pitchboard::cli
