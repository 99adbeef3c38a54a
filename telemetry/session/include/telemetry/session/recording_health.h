// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells what the user should know of a running recording: how much space is left, and whether
// anything is wrong. Pure functions of its status; any thread.

#include <optional>
#include <string>

#include <telemetry/session/session_writer.h>

namespace pitchboard::telemetry {

enum class RecordingTrouble {
  None,
  Dropped,      ///< rows or messages are missing in the file
  LittleSpace,  ///< the disk will be full in a few minutes
  DiskBehind,   ///< the disk does not answer in time
};

/// Returns the most urgent problem.
RecordingTrouble troubleOf(const SessionStatus& status);
/// Returns a sentence about the most urgent problem that says what to do; empty if there is none.
std::string troubleText(const SessionStatus& status);
/// Returns the seconds until the disk is full at the current rate; empty while free space or rate
/// are unknown.
std::optional<double> secondsLeft(const SessionStatus& status);
/// Returns "3 h 20 min until the disk is full", or "52.3 GB free" while the rate is unknown; empty
/// if the system does not report the free space.
std::string freeSpaceText(const SessionStatus& status);

}  // namespace pitchboard::telemetry
