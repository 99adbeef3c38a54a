// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Selects robots of a session: which rows, datagrams, events, drawings, saved states and frames
// belong to them. Robots are chosen by the names of their groups ("B1", "Robot 3 (2)"); none means
// all. One thread at a time.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <telemetry/session/session_export.h>

namespace pitchboard::link {

/// Returns whether the name belongs to one of these robots. "Robot 3" and "B3" can be the same one,
/// because the colour of a live robot's team is not always known.
bool isChosen(std::string_view name, std::span<const std::string> robots);

/// Removes the other robots and their drawings from a frame.
void keepRobots(MatchFrame& frame, std::span<const std::string> robots);

/// Returns the groups that these names mean: "Robot 3" is B3 if no other robot can be meant.
/// Unknown names are returned unchanged.
std::vector<std::string> groupsNamed(const telemetry::SessionReader& session,
                                     std::vector<std::string> robots);

/// Makes an export leave out everything of robots that are not in selection.robots. The referee's
/// packets stay, because of the score; checkpoints, which contain all robots, are left out. Use the
/// selection for one export only, and while the session exists.
void chooseRobots(const telemetry::SessionReader& session, telemetry::ExportFormat format,
                  telemetry::ExportSelection& selection);

}  // namespace pitchboard::link
