// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Colours, type and metrics of the light and dark theme (palette table of docs/design-language.md).
// One accent; team colours mean teams, red and amber mean trouble, green is the field and the
// lamps. UI thread only.

#include <QColor>
#include <QFont>
#include <QIcon>
#include <QPalette>
#include <QString>

#include <simcore/world/team_color.h>

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
  QColor workingMark;  ///< a lamp without its letter, on a collapsed card
  QColor grass, fieldBorder, fieldLines, ball;

  QColor team(TeamColor color) const;
};

/// Colours in force; follows setTheme(). Widgets repaint on QEvent::PaletteChange.
const ThemeColors& theme();
bool isDarkTheme();
/// Applies palette, style sheet and icon theme to the application. With FollowDesktop later changes
/// of the desktop are followed too, where it tells them (its settings portal).
void setTheme(QApplication& application, ThemeChoice choice);
ThemeChoice themeChoice();

/// A Breeze icon drawn in the text colour of the theme, with its disabled state, sharp at any size;
/// a built-in drawing when the icon theme is not installed. Follows later theme changes.
QIcon themedIcon(const QString& name);

/// The type scale, relative to the application's font: body, secondary (age, units, dock titles,
/// status bar), small (lamps, tags), score (bold).
enum class TypeRole { Body, Secondary, Small, Score };
QFont themeFont(TypeRole role, bool bold = false);

/// `pixels` of the mock (drawn for 12 px body text) at the application's font size: keeps
/// proportions at any font size and scaling. The widget is there for the day fonts differ per
/// screen; it may be null.
int scaled(const QWidget* widget, double pixels);

}  // namespace pitchboard::ui
