// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Some robots of a session: what is theirs among its rows, datagrams, events, drawings, saved
// states and frames. Robots are chosen by the names of their groups ("B1", "Robot 3 (2)"); none
// means all. One thread.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <telemetry/session/session_export.h>

namespace pitchboard::link {

/// Whether the name is that of one of these robots. "Robot 3" and "B3" may be one: the colour of a
/// live robot's team is not always known.
bool isChosen(std::string_view name, std::span<const std::string> robots);

/// Takes the others out of a frame, with their drawings.
void keepRobots(MatchFrame& frame, std::span<const std::string> robots);

/// The groups that are meant by these names: "Robot 3" is B3 where no other robot can be. A name
/// that no group has stays.
std::vector<std::string> groupsNamed(const telemetry::SessionReader& session,
                                     std::vector<std::string> robots);

/// Makes an export leave out everything of robots other than selection.robots. The referee's
/// packets stay as they came, for the score; exact states of a match, which hold all robots, are
/// left out. The selection may be used for one export, while the session is there.
void chooseRobots(const telemetry::SessionReader& session, telemetry::ExportFormat format,
                  telemetry::ExportSelection& selection);

}  // namespace pitchboard::link
