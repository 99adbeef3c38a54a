// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Submenus that the card of a robot and the field's context menu share.

#include <vector>

#include <ui/sources/match_controller.h>

class QMenu;

namespace pitchboard::ui {

/// "Behaviour" and "Team" of these robots; what all of them have is marked. Does nothing for robots
/// that the controller does not know.
void addBehaviourMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
/// Who runs for these robots: a built-in profile, a file, a program in place of decision; for one
/// robot also "mine among reference robots".
void addRuntimeMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addTeamMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);

}  // namespace pitchboard::ui
