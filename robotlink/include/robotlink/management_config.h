// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which processes management starts, and how: the section [Pitchboard Management] of a robot's INI
// file (docs/ROBOTS.md). Any thread.

#include <map>
#include <string>
#include <vector>

#include <robotlink/process_manager.h>
#include <robotlink/robot_config.h>

namespace pitchboard::link {

struct ManagementConfig {
  /// Names in the order of starting: reference processes (see cognitiveProcesses()) and those that
  /// have a command.
  std::vector<std::string> processes;
  /// By name: program and arguments of a team's own process; {robot} and {key} stand for numbers.
  std::map<std::string, std::vector<std::string>> commands;
  ManagerTiming timing;
};

/// All reference processes in the order of their list.
ManagementConfig defaultManagement();
/// Errors name file and line: unknown keys, names without a command, times that are not positive.
Result<ManagementConfig> managementFromIni(const IniFile& file);

/// Words, divided by blanks; "double quotes" hold a word with blanks together.
std::vector<std::string> commandWords(std::string_view text);

/// NAME_WORKING of a process "name", absent when the catalog has none.
IntVar workingFlagOf(const std::string& process,
                     const VariableCatalog& catalog = VariableCatalog::published());

}  // namespace pitchboard::link
