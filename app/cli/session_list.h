// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Prints a list of recordings, a line for each: `inspect` of several or of folders. Main thread.

#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::cli {

struct SessionListOptions {
  std::vector<std::string> places;  ///< recordings, and folders with recordings
  bool json = false, csv = false, progress = false;
};

/// Returns the exit code: 1 if a recording cannot be read, at least in part. Fails if a folder
/// cannot be read or has no recordings, and with Conflict if the user interrupted it.
Result<int> listSessions(const SessionListOptions& options);

/// Returns "2026-11-23 14:03:20 UTC".
std::string wallText(telemetry::WallTime time);

}  // namespace pitchboard::cli
