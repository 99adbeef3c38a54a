// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The options of pitchboard-robot, from the command line and from the section [Pitchboard] of the
// robot's INI file, where they have the same names (with _ or -). The command line takes
// precedence. Main thread.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/processes/robot_config.h>

namespace pitchboard::robot {

struct Arguments {
  std::optional<long long> robot;
  std::string config;
  std::optional<int> key;
  int keyBase = 0, match = 0;
  std::optional<int> lockStepSlot;  // passed by the match that runs this process
  // Replace those of the match.
  std::optional<int> telemetryPortBase, teamPortBase, refereePort;
  std::string behaviour = "striker", field = "published", model = "published", attack;
  std::string parameters;                // a file
  std::optional<double> distanceToKick;  // instead of the behaviour's
  double telemetryRate = 1.0;            // Hz
  std::optional<int> cognitionDebugPort;
  std::string announceCycles;  ///< as cycleWordsFromText() reads it; empty: none are announced
  link::ProcessOptions process;

  int blackboardKey() const;  // valid after settle()
};

/// Adds all options. Every process accepts all of them, so that whoever starts the processes can
/// pass the same list to each.
void addOptions(CLI::App& command, Arguments& arguments);

/// Reads the INI file, if one was named, uses its values where the command line gives none, and
/// fills Arguments::process. Returns the file. Errors name file and line.
Result<link::IniFile> settle(CLI::App& command, Arguments& arguments);

/// Returns the options of the command line for another process, without the robot's number, key and
/// file. Call it before settle().
std::vector<std::string> givenOptions(const CLI::App& command);

}  // namespace pitchboard::robot
