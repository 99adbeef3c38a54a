// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs a robot process: calls its steps at a constant rate until a signal ends it. Main thread of
// pitchboard-robot; real time.

#include <chrono>
#include <functional>
#include <memory>

#include <robotlink/blackboard/cycle_words.h>
#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/processes/lock_step_slots.h>

namespace pitchboard::robot {

/// Blocks SIGTERM, SIGINT and SIGHUP until runUntilStopped() or stopRequested() handles them. Call
/// it first, before any thread is started.
void holdEndSignals();

/// Waits at most this long for one of these signals. Returns true if one arrived, also before the
/// call.
bool stopRequested(std::chrono::nanoseconds wait);

/// Steps the process at its period until one of these signals arrives, and returns after the step
/// in progress. Steps are scheduled by absolute time, so that the rate does not drift; missed
/// periods (the computer slept) are skipped. Sends the process's debug data to `display`, if it is
/// not null, five times a second, and announces each step with `announcer`, if it is not null.
void runUntilStopped(link::CognitiveProcess& process, link::Blackboard& board, RobotId robot,
                     link::CognitionDebugSender* display, link::CycleAnnouncer* announcer);

using ProcessMaker = std::function<Result<std::unique_ptr<link::CognitiveProcess>>()>;

/// Runs the process in match time: one step per cycle that the match starts through `slot`, and
/// none otherwise. If the match returns to an earlier moment, the process is replaced by a new one
/// from `make`, which reads its belief from the blackboard. While the match waits, an announced
/// cycle takes long enough for a recorder to read its inputs and outputs. Fails if `make` does.
Result<void> runInLockStep(std::unique_ptr<link::CognitiveProcess> process,
                           const ProcessMaker& make, link::Blackboard& board, RobotId robot,
                           link::LockStepSlot& slot, link::CognitionDebugSender* display,
                           link::CycleAnnouncer* announcer);

}  // namespace pitchboard::robot
