// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every noise value, number of the robots and physics constant, with units; changes act at once. UI
// thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class RobotSelection;
class SourceSwitch;

/// Controller, selection and source must outlive the dock. While `source` shows the past of the
/// match, the dock shows what it was played with then, grey. The numbers of robots are those of the
/// selected ones, or of all when none is selected.
QWidget* makeNoiseDock(MatchController* controller, RobotSelection* selection,
                       const SourceSwitch* source, QWidget* parent);

}  // namespace pitchboard::ui
