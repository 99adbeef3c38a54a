// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the blackboard commands share: which blackboard is meant, by which names, and how a value is
// written.

#include <bit>
#include <string>
#include <vector>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/blackboard/variable_catalog.h>

#include "commands.h"

namespace pitchboard::cli {

/// ROBOT, --key and --key-base of a command.
struct BlackboardTarget {
  int robot = 0;
  int key = 0;
  int keyBase = 0;

  /// For a command whose one argument is the robot.
  void addTo(CLI::App& command);
  void addKeysTo(CLI::App& command);
  /// For a command with more arguments: without --key, the first is the robot.
  Result<void> takeRobotFrom(std::vector<std::string>& arguments);
  /// The System V key; an error when neither or both of robot and key are given.
  Result<int> resolve() const;
};

/// The catalog in `file`, or the published one when the name is empty.
Result<link::VariableCatalog> loadCatalog(const std::string& file);

/// A word as a variable of the type: decimal, or the shortest text that gives the same float.
std::string valueText(link::VariableType type, std::uint32_t word);
/// The same for JSON, where nan and inf have to be texts.
std::string jsonValueText(link::VariableType type, std::uint32_t word);
int wordIndex(const link::Variable& variable);

// In blackboard_values.cpp.
void addDumpCommand(CLI::App& parent, int& exitCode);
void addWatchCommand(CLI::App& parent, int& exitCode);
void addSetCommand(CLI::App& parent, int& exitCode);

}  // namespace pitchboard::cli
