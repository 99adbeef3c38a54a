// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The log with filters of words and level; follows the newest line until one scrolls up; Ctrl+C
// copies, and what is shown can be saved. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class SourceSwitch;
class Timeline;

/// All must outlive the dock. A click on a line shows its moment everywhere, if it is of the source
/// that is shown; what came after the moment shown is pale.
QWidget* makeLogDock(MatchController* controller, const SourceSwitch* source, Timeline* timeline,
                     QWidget* parent);

}  // namespace pitchboard::ui
