// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The mouse wheel changes no control that has no focus: combo boxes, number fields, sliders and tab
// bars leave it to what scrolls behind them, and do not take the focus by it. UI thread only.

class QApplication;

namespace pitchboard::ui {

/// For every window, dock and dialog of the application, present and future; once is enough. The
/// application owns it.
void guardWheel(QApplication& application);

}  // namespace pitchboard::ui
