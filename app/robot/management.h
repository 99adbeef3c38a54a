// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The process `management` of pitchboard-robot, which starts and watches the robot's other
// processes. Main thread.

#include "arguments.h"

namespace pitchboard::robot {

inline constexpr const char* managementDescription =
    "starts, watches and restarts the robot's other processes";

/// Runs until SIGTERM, SIGINT or SIGHUP arrives (see holdEndSignals()), then ends the processes
/// that it started and removes the blackboard if it created it. Fails for invalid options, for a
/// mistake in the INI file (with its line), and for a program that cannot be started.
Result<void> manage(CLI::App& command, Arguments& arguments);

}  // namespace pitchboard::robot
