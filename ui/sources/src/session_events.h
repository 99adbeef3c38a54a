// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Events of the timeline as a session file keeps them, and back.

#include <telemetry/session/session_types.h>
#include <ui/sources/timeline_event.h>

namespace pitchboard::ui {

telemetry::SessionEvent sessionEventOf(const TimelineEvent& event);
/// A kind that nobody knows becomes a warning that says what it was called.
TimelineEvent timelineEventOf(const telemetry::SessionEvent& event);

}  // namespace pitchboard::ui
