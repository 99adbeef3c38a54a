// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the menus of a robot's card, of the field and of the menu bar share, so that each offers the
// same.

#include <vector>

#include <ui/sources/match_controller.h>

class QMenu;

namespace pitchboard::ui {

/// All of the submenus below and the referee's (referee_calls.h), orders first.
void addRobotMenus(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
/// "Order": every action a robot knows, and searching the ball.
void addOrderMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
/// "Behaviour", "Team" and "Model" of these robots, "Number" of one; what all of them have is
/// marked. Does nothing for robots that the controller does not know.
void addBehaviourMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
/// Who runs for these robots: a built-in profile, a file, a program in place of decision; for one
/// robot also "mine among reference robots".
void addRuntimeMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addTeamMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addModelMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addNumberMenu(QMenu* menu, MatchController* controller, RobotId id);

}  // namespace pitchboard::ui
