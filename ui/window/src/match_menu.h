// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The part of the menu Simulation that says what the match was begun with, and begins it again with
// something else: seed, who decides for the robots, its number on this computer. UI thread only.

#include <functional>

class QAction;
class QMenu;

namespace pitchboard::ui {

class MainWindow;
class MatchController;

/// `onlyInTheMatch` greys an entry while another source or the past is shown. Everything outlives
/// `menu`.
void addMatchEntries(QMenu* menu, MatchController* controller, MainWindow* window,
                     const std::function<void(QAction*)>& onlyInTheMatch);

}  // namespace pitchboard::ui
