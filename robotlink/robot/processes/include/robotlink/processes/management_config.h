// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads which processes management starts, and how: the section [Pitchboard Management] of a
// robot's INI file (docs/robot-programs.md). Plain values; any thread.

#include <map>
#include <string>
#include <vector>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/processes/robot_config.h>
#include <robotlink/processes/runtime_profile.h>

namespace pitchboard::link {

struct ManagementTiming {
  using Seconds = RestartRule::Seconds;
  Seconds startInterval{0.2};  ///< time between the starts of two processes
  Seconds responseTimeout{5.0};
  RestartRule restart;
};

struct ManagementConfig {
  /// Names in the order of starting: reference processes, and those with a command.
  std::vector<std::string> processes;
  /// Program and arguments of team programs, by name; {robot} and {key} are replaced.
  std::map<std::string, std::vector<std::string>> commands;
  ManagementTiming timing;
};

/// Reads the section. Without it, a file starts `reference`, the processes that this program can
/// start without a command, in their order. Errors name file and line: unknown keys, names without
/// a command, times that are not positive.
Result<ManagementConfig> managementFromIni(const IniFile& file,
                                           const std::vector<std::string>& reference);

/// Splits a text at blanks; "double quotes" keep an argument with blanks together.
std::vector<std::string> splitCommand(std::string_view text);

/// Returns NAME_WORKING of a process "name"; absent if the catalog has none.
IntVar workingFlagOf(const std::string& process,
                     const VariableCatalog& catalog = VariableCatalog::published());

}  // namespace pitchboard::link
