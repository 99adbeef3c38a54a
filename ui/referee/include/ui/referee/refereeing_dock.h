// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Refereeing the simulated match by hand: states, goals, set plays, penalties, the ball, formations
// and the referee's log. Every call can be undone. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class SourceSwitch;

/// The controller and what is shown must outlive the dock; without the latter the match is always
/// shown.
QWidget* makeRefereeingDock(MatchController* controller, const SourceSwitch* source,
                            QWidget* parent);

}  // namespace pitchboard::ui
