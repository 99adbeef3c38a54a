// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The life of one robot process: steps at a steady rhythm until a signal asks for its end. The
// first thread of pitchboard-robot; times are wall times.

#include <chrono>
#include <functional>
#include <memory>

#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/processes/lock_step_slots.h>

namespace pitchboard::robot {

/// From now on SIGTERM, SIGINT and SIGHUP wait for runUntilStopped() or stopRequested(). Call
/// before anything else.
void holdEndSignals();

/// Waits so long for one of these signals; true when one came, also before the call.
bool stopRequested(std::chrono::nanoseconds wait);

/// Steps the process at its period, by absolute time, until one of these signals arrives: the
/// rhythm does not drift, and a period that was missed (the computer slept) is left out. Returns
/// within a cycle's work of the signal. One thread only. With `display` it is told what the process
/// has in mind, five times a second.
void runUntilStopped(link::CognitiveProcess& process, link::Blackboard& board, RobotId robot,
                     link::CognitionDebugSender* display);

using ProcessMaker = std::function<Result<std::unique_ptr<link::CognitiveProcess>>()>;

/// Runs the process in match time: one step per cycle that the match starts through `slot`, and
/// none otherwise. When the match was put back to an earlier moment, the process is replaced by one
/// from `make`, which reads its belief from the blackboard. Fails when `make` does.
Result<void> runInLockStep(std::unique_ptr<link::CognitiveProcess> process,
                           const ProcessMaker& make, link::Blackboard& board, RobotId robot,
                           link::LockStepSlot& slot, link::CognitionDebugSender* display);

}  // namespace pitchboard::robot
