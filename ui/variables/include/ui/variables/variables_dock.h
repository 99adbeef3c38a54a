// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Variables dock: all variables of all robots with their values (docs/studio.md, "Variables").
// UI thread only.

#include <functional>

class QSettings;
class QWidget;

namespace pitchboard::ui {

class AttachedBoards;
class MatchController;
class PlotTarget;
class RobotSelection;
class ShownMoment;

/// What the dock shows and changes; all must outlive it.
struct VariablesContext {
  MatchController* controller = nullptr;  ///< writes variables of its robots
  ShownMoment* shown = nullptr;
  PlotTarget* plots = nullptr;          ///< where variables can be sent to be plotted; may be null
  QSettings* settings = nullptr;        ///< the user's; may be null
  RobotSelection* selection = nullptr;  ///< requests for a robot's blackboard; may be null
  AttachedBoards* boards = nullptr;     ///< blackboards of this computer; may be null
  std::function<void()> attachBoard{};  ///< opens the dialog that attaches one; may be empty
};

QWidget* makeVariablesDock(const VariablesContext& context, QWidget* parent);

}  // namespace pitchboard::ui
