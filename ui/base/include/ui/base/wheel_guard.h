// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keeps the mouse wheel from changing controls without focus: combo boxes, number fields, sliders
// and tab bars pass it on to the area that scrolls, and do not take the focus. UI thread only.

class QApplication;

namespace pitchboard::ui {

/// Call it once; it applies to all present and future windows. The application owns the guard.
void guardWheel(QApplication& application);

}  // namespace pitchboard::ui
