// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/theme.h>

#include <QApplication>
#include <QFontInfo>
#include <cmath>

#include "desktop_theme.h"
#include "flat_style.h"

namespace pitchboard::ui {
namespace {

ThemeColors makeLight() {
  ThemeColors c;
  c.window = "#eff0f2";
  c.view = "#ffffff";
  c.alternateRow = "#f7f8f9";
  c.button = "#fbfbfc";
  c.innerLine = "#cfd3d8";
  c.outerEdge = "#b9bec5";
  c.text = "#22262b";
  c.secondaryText = "#636b75";
  c.disabledText = "#a1a8b0";
  c.accentLine = "#5f4bb6";
  c.accentFill = "#6a56c2";
  c.selectedRow = "#e3defa";
  c.blueTeam = "#2f6fc6";
  c.redTeam = "#c2413c";
  c.blackTeam = "#3a3f45";
  c.orangeTeam = "#b8621b";
  c.yellowTeam = "#96800f";
  c.warningText = "#a66a00";
  c.warningGround = "#fbeccb";
  c.errorText = "#c02f2a";
  c.errorGround = "#fbdedc";
  c.workingText = "#246240";
  c.workingGround = "#dcefe3";
  c.workingMark = "#3f8a5e";
  c.grass = "#7fae88";
  c.fieldBorder = "#73a37d";
  c.fieldLines = "#ffffff";
  c.ball = "#e8792b";
  return c;
}

ThemeColors makeDark() {
  ThemeColors c;
  c.window = "#2b2e32";
  c.view = "#212428";
  c.alternateRow = "#25282c";
  c.button = "#363a3f";
  c.innerLine = "#3d4248";
  c.outerEdge = "#1b1d20";
  c.text = "#dfe3e8";
  c.secondaryText = "#9ba3ad";
  c.disabledText = "#69717b";
  c.accentLine = "#a594f5";
  c.accentFill = "#5a4d9e";
  c.selectedRow = "#3b3663";
  c.blueTeam = "#4f8fe3";
  c.redTeam = "#d8605b";
  c.blackTeam = "#5b6169";
  c.orangeTeam = "#cc7f35";
  c.yellowTeam = "#b39c2f";
  c.warningText = "#e3ab3f";
  c.warningGround = "#4b3d1e";
  c.errorText = "#f2726b";
  c.errorGround = "#5a2b2b";
  c.workingText = "#a9d6b8";
  c.workingGround = "#2f4a3c";
  c.workingMark = "#5c9f78";
  c.grass = "#33453a";
  c.fieldBorder = "#2c3b32";
  c.fieldLines = "#c3cec6";
  c.ball = "#f0a35e";
  return c;
}

const ThemeColors& lightColors() {
  static const ThemeColors colors = makeLight();
  return colors;
}

const ThemeColors& darkColors() {
  static const ThemeColors colors = makeDark();
  return colors;
}

QPalette paletteOf(const ThemeColors& c) {
  QPalette p;
  const auto set = [&p](QPalette::ColorRole role, const QColor& color) {
    p.setColor(QPalette::All, role, color);
  };
  set(QPalette::Window, c.window);
  set(QPalette::WindowText, c.text);
  set(QPalette::Base, c.view);
  set(QPalette::AlternateBase, c.alternateRow);
  set(QPalette::Text, c.text);
  set(QPalette::PlaceholderText, c.secondaryText);
  set(QPalette::Button, c.button);
  set(QPalette::ButtonText, c.text);
  set(QPalette::BrightText, c.errorText);
  set(QPalette::ToolTipBase, c.window);
  set(QPalette::ToolTipText, c.text);
  set(QPalette::Light, c.button.lighter(110));
  set(QPalette::Midlight, c.button);
  set(QPalette::Mid, c.innerLine);
  set(QPalette::Dark, c.outerEdge);
  set(QPalette::Shadow, c.outerEdge.darker(120));
  set(QPalette::Highlight, c.accentFill);
  set(QPalette::HighlightedText, QColor(Qt::white));
  set(QPalette::Link, c.accentLine);
  set(QPalette::LinkVisited, c.accentLine);
  for (const auto role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText,
        QPalette::ToolTipText, QPalette::PlaceholderText}) {
    p.setColor(QPalette::Disabled, role, c.disabledText);
  }
  p.setColor(QPalette::Disabled, QPalette::Highlight, c.innerLine);
  return p;
}

/// The few things a palette cannot say: tool bars, dock titles, tabs, menus.
QString styleSheetOf(const ThemeColors& c) {
  QString sheet = QStringLiteral(R"(
QMainWindow::separator { background: @edge; width: @2; height: @2; }
QMainWindow::separator:hover { background: @accent; }
QMenuBar { background: @window; border: none; }
QMenuBar::item { padding: @4 @8; background: transparent; }
QMenuBar::item:selected, QMenuBar::item:pressed { background: @row; border-radius: 3px; }
QToolBar { border: none; border-bottom: 1px solid @edge; padding: @4 @8; spacing: @4; }
QToolBar QComboBox { min-height: @24; }
QToolBar#fieldTools, QToolBar[orientation="1"] { border: none; padding: @4; }
QToolBar#plotTools { border: none; padding: 0 @2; spacing: 1px; }
QToolBar#plotTools QToolButton { padding: @2; }
QToolBar::separator:horizontal { background: @line; width: 1px; margin: @4 @8; }
QToolButton { border: 1px solid transparent; border-radius: 3px; padding: @3; }
QToolButton:hover { background: @button; border-color: @line; }
QToolButton#qt_toolbar_ext_button { background: @button; border-color: @line; padding: 0; }
QToolButton:pressed, QToolButton:checked { background: @row; border-color: @accent; }
QToolButton#changedOnly, QToolButton#favouritesOnly {
  border-color: @line; background: @button; }
QToolButton#changedOnly:checked, QToolButton#favouritesOnly:checked {
  background: @row; border-color: @accent; }
QToolButton#mode, QToolButton#now { border-color: @line; background: @button; padding: @4 @12; }
QToolButton#now { padding: @4 @2; }
QToolButton#mode:checked, QToolButton#now:checked { background: @fill; border-color: @fill; color: white; }
QToolButton:focus, QToolButton#changedOnly:focus, QToolButton#favouritesOnly:focus,
QToolButton#mode:focus, QToolButton#now:focus { border-color: @accent; }
QToolButton::menu-indicator { image: none; }
QStatusBar { border-top: 1px solid @edge; }
QStatusBar::item { border: none; }
QDockWidget > QWidget { border: none; }
QTabBar#docks::tab, QMainWindow > QTabBar::tab {
  padding: @4 @8; border: 1px solid transparent; border-top: 2px solid transparent;
  color: @secondary; background: transparent; }
QTabBar::tab { padding: @3 @12; border: 1px solid transparent;
  border-bottom: 2px solid transparent; color: @secondary; background: transparent; }
QTabBar::tab:selected { color: @text; border-bottom-color: @accent; }
QTabBar::tab:hover:!selected { color: @text; }
QTabBar#docks::tab:selected { color: @text; border-top-color: @accent; }
QTabWidget::pane { border: none; border-top: 1px solid @line; }
QProgressBar { background: @view; border: 1px solid @line; border-radius: 3px; text-align: center; }
QProgressBar::chunk { background: @row; border-right: @2 solid @accent; }
QMainWindow > QTabBar::tab:selected {
  color: @text; background: @view; border-color: @line; border-top: 2px solid @accent;
  border-bottom-color: @view; }
QMainWindow > QTabBar::tab:hover:!selected { color: @text; }
QAbstractItemView { selection-background-color: @row; selection-color: @text; }
QScrollBar { background: transparent; border: none; margin: 0; }
QScrollBar:vertical { width: @10; }
QScrollBar:horizontal { height: @10; }
QScrollBar::handle { background: @line; border-radius: 3px; margin: @2; }
QScrollBar::handle:vertical { min-height: @24; }
QScrollBar::handle:horizontal { min-width: @24; }
QScrollBar::handle:hover { background: @secondary; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: none; }
QDockWidget QDoubleSpinBox, QDockWidget QSpinBox, QLineEdit#logFilter,
QLineEdit#variablesFilter { background: @view; color: @text;
  border: 1px solid @line; border-radius: 3px; padding: @2 @4; }
QDockWidget QDoubleSpinBox:focus, QDockWidget QSpinBox:focus, QLineEdit#logFilter:focus,
QLineEdit#variablesFilter:focus { border-color: @accent; }
QDockWidget QDoubleSpinBox::up-button, QDockWidget QDoubleSpinBox::down-button,
QDockWidget QSpinBox::up-button, QDockWidget QSpinBox::down-button { width: 0; border: none; }
QTableView::item { padding: 0 @5; border: none; }
QTableView#marksTable::item { padding: 0 @2; }
QTableView::item:selected { background: @row; color: @text; }
QHeaderView::section { background: @window; color: @secondary; border: none;
  border-bottom: 1px solid @line; padding: @3 @8; }
QTreeView#variablesView QHeaderView::section { padding: @3 @5; }
QToolTip { background: @window; color: @text; border: 1px solid @line; }
)");
  const std::pair<const char*, QColor> names[] = {
      {"@window", c.window},   {"@view", c.view},       {"@button", c.button},
      {"@line", c.innerLine},  {"@edge", c.outerEdge},  {"@accent", c.accentLine},
      {"@fill", c.accentFill}, {"@row", c.selectedRow}, {"@secondary", c.secondaryText},
      {"@text", c.text}};
  for (const auto& [name, color] : names) sheet.replace(QLatin1String(name), color.name());
  for (const int pixels : {24, 12, 10, 8, 6, 5, 4, 3, 2}) {
    sheet.replace(QStringLiteral("@%1").arg(pixels),
                  QStringLiteral("%1px").arg(scaled(nullptr, pixels)));
  }
  return sheet;
}

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
