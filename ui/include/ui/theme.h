// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Colours and metrics of the light and dark theme (palette table of docs/DESIGN_LANGUAGE.md). One
// accent; team colours mean teams, red and amber mean trouble, green is the field and the lamps.

#include <QColor>
#include <QIcon>
#include <QPalette>
#include <QString>

#include <base/ids.h>

class QApplication;
class QWidget;

namespace pitchboard::ui {

enum class ThemeChoice { FollowDesktop, Light, Dark };

struct ThemeColors {
  QColor window, view, alternateRow, button, innerLine, outerEdge;
  QColor text, secondaryText, disabledText;
  QColor accentLine, accentFill, selectedRow;
  QColor blueTeam, redTeam, blackTeam, orangeTeam, yellowTeam;
  QColor warningText, warningGround, errorText, errorGround, workingText, workingGround;
  QColor grass, fieldBorder, fieldLines, ball;

  QColor team(TeamColor color) const;
};

/// Colours in force; follows setTheme(). Widgets repaint on QEvent::PaletteChange.
const ThemeColors& theme();
bool isDarkTheme();
/// Applies palette, style sheet and icon theme to the application.
void setTheme(QApplication& application, ThemeChoice choice);

/// A Breeze icon drawn in the text colour of the theme, with its disabled state.
QIcon themedIcon(const QString& name);

/// `pixels` of the mock (drawn for 12 px body text) in the widget's font: keeps proportions at any
/// font size and scaling.
int scaled(const QWidget* widget, double pixels);

}  // namespace pitchboard::ui
