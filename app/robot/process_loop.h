// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <robotlink/cognitive_process.h>

namespace pitchboard::robot {

/// From now on SIGTERM, SIGINT and SIGHUP wait for runUntilAsked(). Call before anything else.
void holdEndSignals();

/// Steps the process at its period, by absolute time, until one of these signals arrives: the
/// rhythm does not drift, and a period that was missed (the computer slept) is left out. Returns
/// within a cycle's work of the signal. One thread only.
void runUntilAsked(link::CognitiveProcess& process, link::Blackboard& board);

}  // namespace pitchboard::robot
