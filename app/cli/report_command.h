// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// `export FILE --to report`: the report of a session, without a display.

#include <functional>
#include <string>
#include <vector>

#include <telemetry/session/session_reader.h>

namespace pitchboard::cli {

/// The part of the session in the closed range (s; may reach beyond it) as an HTML page. Never over
/// an existing file.
Result<void> exportReport(const telemetry::SessionReader& session, telemetry::TimeRange range,
                          const std::vector<std::string>& robots, const std::string& output);

}  // namespace pitchboard::cli
