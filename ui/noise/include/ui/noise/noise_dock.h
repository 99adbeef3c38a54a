// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every noise value and physics constant, with units; changes act at once. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;

/// The controller must outlive the dock.
QWidget* makeNoiseDock(MatchController* controller, QWidget* parent);

}  // namespace pitchboard::ui
