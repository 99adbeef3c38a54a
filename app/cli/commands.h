// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The commands of pitchboard-cli. Each file adds one command or group to the parser. A command sets
// `exitCode`: 0 done, 1 the answer is no, 2 an error that was printed as "error: ...". Main thread.

#include <CLI/CLI.hpp>

#include <sys/stat.h>
#include <algorithm>
#include <memory>
#include <string>

#include <app/command_line.h>
#include <app/usage.h>
#include <base/file_target.h>

namespace pitchboard::cli {

/// Name and version of the program, which are written into its files.
inline constexpr const char* programName = "pitchboard " PITCHBOARD_VERSION;

/// Returns the text, padded with blanks to this many characters (not bytes).
inline std::string padded(const std::string& text, std::size_t width) {
  const auto shown = static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
  return text + std::string(shown < width ? width - shown : 0, ' ');
}

/// A function that adds a command. The list of all of them is in main.cpp.
using AddCommand = void (*)(CLI::App& parent, int& exitCode);

void addSimulateCommand(CLI::App& parent, int& exitCode);
void addConformanceCommand(CLI::App& parent, int& exitCode);
void addBlackboardCommands(CLI::App& parent, int& exitCode);
void addCatalogCommands(CLI::App& parent, int& exitCode);
void addListenCommand(CLI::App& parent, int& exitCode);
void addDecodeCommand(CLI::App& parent, int& exitCode);
void addInspectCommand(CLI::App& parent, int& exitCode);
void addRepairCommand(CLI::App& parent, int& exitCode);
void addJoinCommand(CLI::App& parent, int& exitCode);
void addRecordCommand(CLI::App& parent, int& exitCode);
void addExportCommand(CLI::App& parent, int& exitCode);
void addFindCommand(CLI::App& parent, int& exitCode);
void addCheckCommand(CLI::App& parent, int& exitCode);
void addStatisticsCommand(CLI::App& parent, int& exitCode);
void addImportCommand(CLI::App& parent, int& exitCode);
void addExperimentCommand(CLI::App& parent, int& exitCode);
void addTournamentCommand(CLI::App& parent, int& exitCode);
void addTestCommand(CLI::App& parent, int& exitCode);
void addLearnCommand(CLI::App& parent, int& exitCode);
void addCalibrateCommand(CLI::App& parent, int& exitCode);
void addExploreCommand(CLI::App& parent, int& exitCode);
void addRerunCommand(CLI::App& parent, int& exitCode);
void addServeCommand(CLI::App& parent, int& exitCode);

using shared::addGroup;
using shared::reportError;

/// Reports the error of a command that failed.
inline int exitCodeOf(const Result<int>& done) {
  return done ? *done : reportError(done.error());
}

/// Adds --force, which lets a command replace what it has written before.
inline void addForce(CLI::App& command, bool& force,
                     const char* description = "Replace an existing file") {
  command.add_flag("--force", force, description);
}

/// What happens to an existing file. Without --force it is refused here, before the work begins and
/// with the option's name. An empty path is fine; `source`, which is read, is refused by whoever
/// writes.
inline Result<IfExists> ifExists(const std::string& path, bool force,
                                 const std::string& source = {}) {
  struct stat old {};
  if (force) return IfExists::Replace;
  if (path.empty() || ::lstat(path.c_str(), &old) != 0 || isSameFile(path, source)) {
    return IfExists::Refuse;
  }
  return failure(ErrorCode::Conflict,
                 "This file exists; add --force to replace it, or choose another name.", path);
}

/// Runs `run(*options)` when this command was chosen, and sets the exit code.
template <class Options, class Run>
void whenChosen(CLI::App& command, const std::shared_ptr<Options>& options, int& exitCode,
                Run run) {
  command.callback([options, &exitCode, run] { exitCode = exitCodeOf(run(*options)); });
}

}  // namespace pitchboard::cli
