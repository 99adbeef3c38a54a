// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Menus about robots, shared by robot cards, field and menu bar. UI thread only.

#include <vector>

#include <ui/sources/match_controller.h>

class QMenu;

namespace pitchboard::ui {

/// Adds all submenus below and those of the referee (referee_calls.h).
void addRobotMenus(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
/// Adds "Order": all actions of a robot, and searching for the ball.
void addOrderMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
// Add "Behaviour", "Runtime", "Team" and "Model" for these robots, and "Number" for one. What all
// of them have is checked. Nothing is added for robots that are not in the match. A runtime is a
// built-in profile, a file, or a program that replaces the decision process.
void addBehaviourMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addRuntimeMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addTeamMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addModelMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids);
void addNumberMenu(QMenu* menu, MatchController* controller, RobotId id);

}  // namespace pitchboard::ui
