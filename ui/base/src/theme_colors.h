// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The two colour tables, and what Qt needs to draw with them.

#include <ui/base/theme.h>

namespace pitchboard::ui {

const ThemeColors& lightColors();
const ThemeColors& darkColors();
QPalette paletteOf(const ThemeColors& colors);
/// The few things a palette cannot say: tool bars, dock titles, tabs, menus.
QString styleSheetOf(const ThemeColors& colors);

}  // namespace pitchboard::ui
