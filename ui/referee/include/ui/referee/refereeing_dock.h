// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Refereeing the simulated match by hand: states, goals, set plays, penalties, the ball, formations
// and the referee's log. Every call can be undone. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;

/// The controller must outlive the dock.
QWidget* makeRefereeingDock(MatchController* controller, QWidget* parent);

}  // namespace pitchboard::ui
