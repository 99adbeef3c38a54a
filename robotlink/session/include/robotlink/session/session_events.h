// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Events as a session file keeps them, and back. Plain functions; any thread.

#include <vector>

#include <robotlink/frame/match_event.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::link {

telemetry::SessionEvent sessionEvent(const MatchEvent& event);
/// A kind that nobody knows becomes Other, which says what it was called. Of an event without facts
/// the words are kept.
MatchEvent matchEvent(const telemetry::SessionEvent& event);

/// All of a session in order of time. Events of 0.8 get the key of their robot from its rows.
std::vector<MatchEvent> eventsOf(const telemetry::SessionReader& session);

}  // namespace pitchboard::link
