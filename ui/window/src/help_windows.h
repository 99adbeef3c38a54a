// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QWidget;

namespace pitchboard::ui {

// Neither is modal; both delete themselves when closed.
void showShortcuts(QWidget* parent);
void showAbout(QWidget* parent);

}  // namespace pitchboard::ui
