// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/theme.h>

#include <QApplication>
#include <QFontInfo>
#include <cmath>

#include "desktop_theme.h"
#include "flat_style.h"
#include "theme_colors.h"

namespace pitchboard::ui {
namespace {

// What the application looks like belongs to the application: one value, like its palette.
struct Current {
  ThemeChoice choice = ThemeChoice::FollowDesktop;
  bool dark = false;
};
Current& current() {
  static Current value;
  return value;
}

void apply(QApplication& application, bool dark) {
  current().dark = dark;
  QApplication::setPalette(paletteOf(theme()));
  application.setStyleSheet(styleSheetOf(theme()));
}

}  // namespace

QColor ThemeColors::team(TeamColor color) const {
  const QColor* const colors[] = {&blueTeam, &redTeam, &blackTeam, &orangeTeam, &yellowTeam};
  return *colors[static_cast<std::size_t>(color)];
}

const ThemeColors& theme() {
  return current().dark ? darkColors() : lightColors();
}
bool isDarkTheme() {
  return current().dark;
}
ThemeChoice themeChoice() {
  return current().choice;
}

void setTheme(QApplication& application, ThemeChoice choice) {
  DesktopTheme* desktop = DesktopTheme::of(application);
  if (application.property("pitchboardStyled").isNull()) {
    application.setProperty("pitchboardStyled", true);
    QApplication::setStyle(new FlatStyle);
    QObject::connect(desktop, &DesktopTheme::changed, &application, [&application](bool dark) {
      if (current().choice == ThemeChoice::FollowDesktop) apply(application, dark);
    });
  }
  current().choice = choice;
  apply(application,
        choice == ThemeChoice::FollowDesktop ? desktop->isDark() : choice == ThemeChoice::Dark);
}

QFont themeFont(TypeRole role, bool bold) {
  constexpr double shares[] = {1.0, 8.0 / 9.0, 7.5 / 9.0, 11.0 / 9.0};
  QFont font = QApplication::font();
  const double share = shares[static_cast<int>(role)];
  if (font.pointSizeF() > 0) {
    font.setPointSizeF(font.pointSizeF() * share);
  } else {
    font.setPixelSize(static_cast<int>(std::lround(font.pixelSize() * share)));
  }
  font.setBold(bold || role == TypeRole::Score);
  return font;
}

int scaled(const QWidget*, double pixels) {
  constexpr double bodyOfTheMock = 12.0;
  const double body = QFontInfo(QApplication::font()).pixelSize();
  return static_cast<int>(std::lround(pixels * body / bodyOfTheMock));
}

}  // namespace pitchboard::ui
