// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes frames of what was heard. A pure function of its arguments but for the identities, which
// stay with a robot as long as it is remembered. Private to robotlink.

#include <robotlink/live/live_books.h>

namespace pitchboard::link {

/// Everything but the serial. `time`: seconds since the watch began.
MatchFrame liveFrame(const LiveOptions& options, const telemetry::TeamStatus& team,
                     const telemetry::RefereeTracker& referee, LiveIdentities& identities,
                     double time);

/// "blue" to Blue; nothing for colours that robots cannot be drawn in.
std::optional<TeamColor> teamColour(std::string_view words);

}  // namespace pitchboard::link
