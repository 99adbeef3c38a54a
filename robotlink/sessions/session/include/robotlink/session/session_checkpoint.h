// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How pieces of a simulated match stand in a session file: JSON messages of the stream Checkpoints,
// with the bytes of StateSegment in base64. Any thread that may use the file.

#include <robotlink/session/state_segment.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_writer.h>

namespace pitchboard::link {

/// One JSON message; its time is that of the first tick.
std::string checkpointToJson(const StateSegment& segment);
Result<StateSegment> checkpointFromJson(std::string_view json);

void appendCheckpoint(telemetry::SessionWriter& session, const StateSegment& segment);

struct SessionCheckpoint {
  double time = 0.0;  ///< s of the session, at the segment's first tick
  StateSegment segment;
};

/// The last piece that begins at or before `seconds`. Error NotFound when there is none.
Result<SessionCheckpoint> checkpointAt(const telemetry::SessionReader& session, double seconds);

}  // namespace pitchboard::link
