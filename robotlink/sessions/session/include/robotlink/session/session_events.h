// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts events to the form of session files and back. Pure functions; any thread.

#include <vector>

#include <robotlink/frame/match_event.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::link {

telemetry::SessionEvent sessionEvent(const MatchEvent& event);
/// Converts an event of a file. An unknown kind becomes Other, which keeps its name; an event
/// without facts keeps its text.
MatchEvent matchEvent(const telemetry::SessionEvent& event);

/// Returns all events of a session in order of time. Before 0.24 events say only by name of which
/// robot they are.
std::vector<MatchEvent> eventsOf(const telemetry::SessionReader& session);

}  // namespace pitchboard::link
