// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the blackboard commands share: which blackboard is meant, and by which names.

#include <string>
#include <vector>

#include <robotlink/blackboard/system_v.h>

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

// In blackboard_values.cpp.
void addDumpCommand(CLI::App& parent, int& exitCode);
void addWatchCommand(CLI::App& parent, int& exitCode);
void addSetCommand(CLI::App& parent, int& exitCode);

}  // namespace pitchboard::cli
