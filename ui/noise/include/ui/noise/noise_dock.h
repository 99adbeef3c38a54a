// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dock with all values of noise, robot models and physics. Changes take effect immediately. UI
// thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class RobotSelection;
class ShownMoment;

/// All arguments must outlive the dock. While `source` shows the past of the match, the dock shows
/// the values of that time, disabled. Values of robot models are those of the selected robots, or
/// of all robots if none is selected.
QWidget* makeNoiseDock(MatchController* controller, RobotSelection* selection,
                       const ShownMoment* shown, QWidget* parent);

}  // namespace pitchboard::ui
