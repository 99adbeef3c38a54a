// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The windows of the Help menu. Window thread; neither is modal, and both delete themselves when
// closed.

class QWidget;

namespace pitchboard::ui {

class KeyMap;

/// The whole map of keys in a table that can be searched.
void showShortcuts(QWidget* parent, const KeyMap& keys);
void showAbout(QWidget* parent);

}  // namespace pitchboard::ui
