// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every noise value, number of the robots and physics constant, with units; changes act at once. UI
// thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class RobotSelection;

/// Controller and selection must outlive the dock. The numbers of robots are those of the selected
/// ones, or of all when none is selected.
QWidget* makeNoiseDock(MatchController* controller, RobotSelection* selection, QWidget* parent);

}  // namespace pitchboard::ui
