// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options that the blackboard commands share: which blackboard they use. Used at the start of a
// command, on the main thread.

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

  /// Adds ROBOT and the keys to a command whose only argument is the robot.
  void addTo(CLI::App& command);
  /// Adds only --key and --key-base.
  void addKeysTo(CLI::App& command);
  /// For a command with more arguments: takes the robot from the first one unless --key is given.
  Result<void> takeRobotFrom(std::vector<std::string>& arguments);
  /// Returns the System V key. Fails if neither or both of robot and key are given.
  Result<int> resolve() const;
};

// In blackboard_values.cpp.
void addDumpCommand(CLI::App& parent, int& exitCode);
void addWatchCommand(CLI::App& parent, int& exitCode);
void addSetCommand(CLI::App& parent, int& exitCode);

}  // namespace pitchboard::cli
