// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes frames of what was heard: a pure function of its arguments. Private to robotlink.

#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

/// Everything but the serial. `time`: seconds since the watch began.
MatchFrame liveFrame(const LiveOptions& options, const telemetry::TeamStatus& team,
                     const telemetry::RefereeTracker& referee, double time);

/// "blue" to Blue; nothing for colours that robots cannot be drawn in.
std::optional<TeamColor> teamColour(std::string_view words);
/// For the name of a robot that is heard: where an attached blackboard has the number, the board is
/// the first sender.
RobotKey besideBoards(const LiveOptions& options, RobotKey robot, const Teams& teams);

}  // namespace pitchboard::link
