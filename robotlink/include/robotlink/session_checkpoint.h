// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pieces of a simulated match in a session file: each stands at the time of its first tick.

#include <robotlink/state_segment.h>
#include <telemetry/session_reader.h>
#include <telemetry/session_writer.h>

namespace pitchboard::link {

void appendCheckpoint(telemetry::SessionWriter& session, const StateSegment& segment);

struct SessionCheckpoint {
  double time = 0.0;        ///< s of the session, at the segment's first tick
  StateSegment segment;
};

/// The last piece that begins at or before `seconds`. Error NotFound when there is none.
Result<SessionCheckpoint> checkpointAt(const telemetry::SessionReader& session, double seconds);

}  // namespace pitchboard::link
