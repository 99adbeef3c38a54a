// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The windows of the Help menu. Window thread; neither is modal, and both delete themselves when
// closed.

class QMainWindow;
class QWidget;

namespace pitchboard::ui {

/// Every shortcut of the menus, and what mouse and keys do elsewhere.
void showShortcuts(QMainWindow* parent);
void showAbout(QWidget* parent);

}  // namespace pitchboard::ui
