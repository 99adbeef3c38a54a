// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace pitchboard::ui {

struct ThemeColors;

/// The few rules that Fusion and the palette cannot express: toolbar, dock titles, tabs, lines.
QString styleSheet(const ThemeColors& colors);

}  // namespace pitchboard::ui
