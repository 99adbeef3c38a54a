// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which processes management starts, and how: the section [Pitchboard Management] of a robot's INI
// file (docs/robot-programs.md). Any thread.

#include <map>
#include <string>
#include <vector>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/processes/robot_config.h>
#include <robotlink/processes/runtime_profile.h>

namespace pitchboard::link {

struct ManagementTiming {
  using Seconds = RestartRule::Seconds;
  Seconds startInterval{0.2};  ///< between the starts of two processes
  Seconds silentAfter{5.0};
  RestartRule restart;
};

struct ManagementConfig {
  /// Names in the order of starting: reference processes and those that have a command.
  std::vector<std::string> processes;
  /// By name: program and arguments of a team's own process; {robot} and {key} stand for numbers.
  std::map<std::string, std::vector<std::string>> commands;
  ManagementTiming timing;
};

/// Without a section of its own a file starts `reference`: names of the processes that this program
/// can start without a command, in their order. Errors name file and line: unknown keys, names
/// without a command, times that are not positive.
Result<ManagementConfig> managementFromIni(const IniFile& file,
                                           const std::vector<std::string>& reference);

/// Words, divided by blanks; "double quotes" hold a word with blanks together.
std::vector<std::string> commandWords(std::string_view text);

/// NAME_WORKING of a process "name", absent when the catalog has none.
IntVar workingFlagOf(const std::string& process,
                     const VariableCatalog& catalog = VariableCatalog::published());

}  // namespace pitchboard::link
