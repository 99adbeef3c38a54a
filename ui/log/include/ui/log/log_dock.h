// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The log with a filter of words; follows the newest line until one scrolls up; Ctrl+C copies. UI
// thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class SourceSwitch;

/// Both must outlive the dock.
QWidget* makeLogDock(MatchController* controller, const SourceSwitch* source, QWidget* parent);

}  // namespace pitchboard::ui
