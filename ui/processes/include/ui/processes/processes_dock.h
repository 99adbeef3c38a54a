// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Processes dock: a table of the robots' processes, with Restart and Stop in the context menu.
// UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class ShownMoment;

/// Both must outlive the dock.
QWidget* makeProcessesDock(MatchController* controller, ShownMoment* shown, QWidget* parent);

}  // namespace pitchboard::ui
