// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The command `export FILE --to report`, which writes the report of a session. It needs no display.
// Main thread.

#include <functional>
#include <string>
#include <vector>

#include <telemetry/session/session_reader.h>

namespace pitchboard::cli {

/// Writes the part of the session in the closed range (s, may exceed the session) as an HTML page.
/// Never overwrites a file.
Result<void> exportReport(const telemetry::SessionReader& session, telemetry::TimeRange range,
                          const std::vector<std::string>& robots, const std::string& output);

}  // namespace pitchboard::cli
