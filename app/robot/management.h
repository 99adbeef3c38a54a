// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// pitchboard-robot management: the other processes of this robot, started and watched over.

#include "arguments.h"

namespace pitchboard::robot {

inline constexpr const char* managementDescription =
    "starts, watches and restarts the robot's other processes";

/// Runs until SIGTERM, SIGINT or SIGHUP (held by holdEndSignals()), then ends what it started and
/// removes the blackboard if it made it. Errors: options, the INI file (with its line), a program
/// that cannot be started.
Result<void> manage(CLI::App& command, Arguments& arguments);

}  // namespace pitchboard::robot
