// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Colours, fonts and sizes of the light and dark theme (docs/design-language.md has the palette).
// There is one accent colour; team colours stand for teams only, red and amber for problems, green
// for the field and for working processes. UI thread only.

#include <QColor>
#include <QFont>
#include <QIcon>
#include <QPalette>
#include <QString>

#include <base/team_color.h>

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
  QColor workingMark;  ///< lamp without a letter, on a collapsed card
  QColor grass, fieldBorder, fieldLines, ball;

  QColor team(TeamColor color) const;
};

/// Returns the current colours. Widgets repaint on QEvent::PaletteChange after setTheme().
const ThemeColors& theme();
bool isDarkTheme();
/// Applies palette, style sheet and icon theme to the application. With FollowDesktop, later
/// changes are followed if the desktop reports them (through its settings portal).
void setTheme(QApplication& application, ThemeChoice choice);
ThemeChoice themeChoice();

/// Returns a Breeze icon in the text colour of the theme, sharp at any size; a built-in drawing if
/// the icon theme is not installed. Follows later theme changes.
QIcon themedIcon(const QString& name);

/// Font sizes relative to the application's font: body, secondary (age, units, dock titles, status
/// bar), small (lamps, tags), score (bold).
enum class TypeRole { Body, Secondary, Small, Score };
QFont themeFont(TypeRole role, bool bold = false);

/// Converts pixels of the design, which has body text of 12 px, to the application's font size, so
/// that proportions stay the same. `widget` is reserved for fonts that differ per screen and may be
/// null.
int scaled(const QWidget* widget, double pixels);

}  // namespace pitchboard::ui
