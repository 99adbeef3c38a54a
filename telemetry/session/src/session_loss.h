// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is lost with a damaged part of a session, in a sentence: where it stands in the file, why,
// how many messages, and in which seconds of the session. Any thread.

#include <string>

#include <telemetry/mcap/mcap_records.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::telemetry {

/// `start`: when second 0 of the session was.
std::string lossText(const McapLoss& loss, WallTime start);

}  // namespace pitchboard::telemetry
