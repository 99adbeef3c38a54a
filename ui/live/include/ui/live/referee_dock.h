// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All that the referee says, at a glance: state and clock, the set play, who takes it and what is
// counted down, every player of both teams with penalty and cards, and in monitor mode what really
// happens and what robots told the referee. UI thread only.

class QWidget;

namespace pitchboard::ui {

class SourceSwitch;

/// Of the shown source's frames. `source` must outlive the dock.
QWidget* makeRefereeDock(SourceSwitch* source, QWidget* parent);

}  // namespace pitchboard::ui
