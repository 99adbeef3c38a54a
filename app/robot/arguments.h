// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The options of pitchboard-robot, on the command line and in the section [Pitchboard] of the
// robot's INI file, where they have the same names (with _ or -). The command line wins.

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
  // Instead of the match's.
  std::optional<int> telemetryPortBase, teamPortBase, refereePort;
  std::string behaviour = "striker", field = "published", model = "published", attack;
  std::string parameters;                // a file
  std::optional<double> distanceToKick;  // instead of the behaviour's
  double telemetryRate = 1.0;            // Hz
  std::optional<int> cognitionDebugPort;
  link::ProcessOptions process = [] {
    link::ProcessOptions usual;
    usual.advisor.share = 0.25;
    return usual;
  }();

  int blackboardKey() const;  // once settled
};

/// Every process takes every option, so that a starter can give one list to all of them.
void addOptions(CLI::App& command, Arguments& arguments);

/// Reads the INI file, if one was named, takes over what the command line did not say, and fills
/// Arguments::process. Errors name the file and the line. The file is handed back.
Result<link::IniFile> settle(CLI::App& command, Arguments& arguments);

/// The options given on the command line, for a process that is to get the same; without the
/// robot's number, key and file. Call before settle().
std::vector<std::string> givenOptions(const CLI::App& command);

}  // namespace pitchboard::robot
