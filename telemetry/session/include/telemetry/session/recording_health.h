// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person should know of a recording that goes on: how much room is left, and whether
// something threatens it. Pure functions of its status; any thread.

#include <optional>
#include <string>

#include <telemetry/session/session_writer.h>

namespace pitchboard::telemetry {

enum class RecordingTrouble {
  None,
  Dropped,      ///< something is missing in the file
  LittleSpace,  ///< the disk is full in a few minutes
  DiskBehind,   ///< the disk does not answer in time
};

/// The most urgent one.
RecordingTrouble troubleOf(const SessionStatus& status);
/// One sentence about it with what to do; empty when there is none.
std::string troubleText(const SessionStatus& status);
/// Until the disk is full at the present rate; nothing while free space or rate are not known.
std::optional<double> secondsLeft(const SessionStatus& status);
/// "room for 3 h 20 min", or "52.3 GB free" while the rate is not known; empty when the system does
/// not say how much is free.
std::string freeSpaceText(const SessionStatus& status);

}  // namespace pitchboard::telemetry
