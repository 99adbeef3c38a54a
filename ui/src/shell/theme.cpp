// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/theme.h>

#include <QApplication>
#include <QStyleFactory>
#include <QWidget>
#include <array>

#include "style_sheet.h"

namespace pitchboard::ui {
namespace {

struct ThemedColor {
  QColor ThemeColors::* member;
  const char* dark;
  const char* light;
};

/// The palette table of docs/DESIGN_LANGUAGE.md.
constexpr std::array<ThemedColor, 28> palette{{
    {&ThemeColors::window, "#2b2e32", "#eff0f2"},
    {&ThemeColors::view, "#212428", "#ffffff"},
    {&ThemeColors::alternateRow, "#25282c", "#f7f8f9"},
    {&ThemeColors::button, "#363a3f", "#fbfbfc"},
    {&ThemeColors::innerLine, "#3d4248", "#cfd3d8"},
    {&ThemeColors::outerEdge, "#1b1d20", "#b9bec5"},
    {&ThemeColors::text, "#dfe3e8", "#22262b"},
    {&ThemeColors::secondaryText, "#9ba3ad", "#636b75"},
    {&ThemeColors::disabledText, "#69717b", "#a1a8b0"},
    {&ThemeColors::accentLine, "#a594f5", "#5f4bb6"},
    {&ThemeColors::accentFill, "#5a4d9e", "#6a56c2"},
    {&ThemeColors::selectedRow, "#3b3663", "#e3defa"},
    {&ThemeColors::blueTeam, "#4f8fe3", "#2f6fc6"},
    {&ThemeColors::redTeam, "#d8605b", "#c2413c"},
    {&ThemeColors::blackTeam, "#5b6068", "#3a3e44"},
    {&ThemeColors::orangeTeam, "#c9863a", "#b0650f"},
    {&ThemeColors::yellowTeam, "#b9a53f", "#8f7c14"},
    {&ThemeColors::warningText, "#e3ab3f", "#a66a00"},
    {&ThemeColors::warningGround, "#4b3d1e", "#fbeccb"},
    {&ThemeColors::errorText, "#f2726b", "#c02f2a"},
    {&ThemeColors::errorGround, "#5a2b2b", "#fbdedc"},
    {&ThemeColors::workingText, "#a9d6b8", "#246240"},
    {&ThemeColors::workingGround, "#2f4a3c", "#dcefe3"},
    {&ThemeColors::workingDot, "#5c9f78", "#3f8a5e"},
    {&ThemeColors::grass, "#33453a", "#7fae88"},
    {&ThemeColors::fieldBorder, "#2c3b32", "#73a37d"},
    {&ThemeColors::fieldLines, "#c3cec6", "#ffffff"},
    {&ThemeColors::ball, "#f0a35e", "#e8792b"},
}};

ThemeColors makeColors(bool dark) {
  ThemeColors colors;
  for (const ThemedColor& entry : palette) {
    colors.*entry.member = QColor(QLatin1String(dark ? entry.dark : entry.light));
  }
  return colors;
}

bool darkInForce = true;

bool desktopIsDark(const QApplication& application) {
  // Asked once, before our own palette stands there.
  static const bool dark = application.palette().color(QPalette::Window).lightness() < 128;
  return dark;
}

QPalette paletteOf(const ThemeColors& c) {
  QPalette p;
  p.setColor(QPalette::Window, c.window);
  p.setColor(QPalette::WindowText, c.text);
  p.setColor(QPalette::Base, c.view);
  p.setColor(QPalette::AlternateBase, c.alternateRow);
  p.setColor(QPalette::Text, c.text);
  p.setColor(QPalette::PlaceholderText, c.secondaryText);
  p.setColor(QPalette::Button, c.button);
  p.setColor(QPalette::ButtonText, c.text);
  p.setColor(QPalette::ToolTipBase, c.window);
  p.setColor(QPalette::ToolTipText, c.text);
  p.setColor(QPalette::BrightText, c.errorText);
  p.setColor(QPalette::Highlight, c.accentFill);
  p.setColor(QPalette::HighlightedText, QColor(Qt::white));
  p.setColor(QPalette::Link, c.accentLine);
  p.setColor(QPalette::LinkVisited, c.accentLine);
  p.setColor(QPalette::Light, c.button);
  p.setColor(QPalette::Midlight, c.button);
  p.setColor(QPalette::Mid, c.innerLine);
  p.setColor(QPalette::Dark, c.outerEdge);
  p.setColor(QPalette::Shadow, c.outerEdge);
  for (const QPalette::ColorRole role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText}) {
    p.setColor(QPalette::Disabled, role, c.disabledText);
  }
  p.setColor(QPalette::Disabled, QPalette::Highlight, c.innerLine);
  return p;
}

}  // namespace

QColor ThemeColors::team(TeamColor color) const {
  const std::array<const QColor*, 5> byTeam{&blueTeam, &redTeam, &blackTeam, &orangeTeam,
                                            &yellowTeam};
  return *byTeam[static_cast<std::size_t>(color)];
}

const ThemeColors& theme() {
  static const ThemeColors dark = makeColors(true);
  static const ThemeColors light = makeColors(false);
  return darkInForce ? dark : light;
}

bool isDarkTheme() { return darkInForce; }

void setTheme(QApplication& application, ThemeChoice choice) {
  const bool desktop = desktopIsDark(application);
  darkInForce = choice == ThemeChoice::FollowDesktop ? desktop : choice == ThemeChoice::Dark;
  application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  application.setPalette(paletteOf(theme()));
  application.setStyleSheet(styleSheet(theme()));
}

QFont bodyFont(const QWidget* widget, double pixels, bool bold) {
  constexpr double bodyPixels = 12.0;
  QFont font = widget->font();
  const double factor = pixels / bodyPixels;
  // The application's body font counts, so that a widget with a font of its own does not compound.
  const QFont base = QApplication::font();
  if (base.pointSizeF() > 0) {
    font.setPointSizeF(base.pointSizeF() * factor);
  } else {
    font.setPixelSize(qRound(base.pixelSize() * factor));
  }
  font.setBold(bold);
  return font;
}

int scaled(const QWidget* widget, double pixels) {
  constexpr double bodyPixels = 12.0;
  Q_UNUSED(widget);
  return qRound(pixels * QFontInfo(QApplication::font()).pixelSize() / bodyPixels);
}

}  // namespace pitchboard::ui
