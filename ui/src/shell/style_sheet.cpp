// SPDX-License-Identifier: GPL-3.0-or-later
#include "style_sheet.h"

#include <ui/theme.h>

namespace pitchboard::ui {

QString styleSheet(const ThemeColors& c) {
  QString sheet = QStringLiteral(R"(
QMainWindow::separator { background: @edge; width: 4px; height: 4px; }
QMainWindow::separator:hover { background: @accent; }
QToolBar { background: @window; border: none; border-bottom: 1px solid @edge; spacing: 4px; padding: 5px 8px; }
QToolBar#fieldTools { border-bottom: none; border-right: 1px solid @edge; padding: 4px; }
QToolBar::separator { background: @inner; width: 1px; height: 1px; margin: 4px 6px; }
QToolButton { border: 1px solid transparent; border-radius: 3px; padding: 3px; }
QToolButton:hover { background: @button; border-color: @inner; }
QToolButton:pressed, QToolButton:checked { background: @selected; border-color: @accent; }
QToolButton:focus { border-color: @accent; }
QToolButton#mode { border-color: @inner; padding: 4px 12px; }
QToolButton#mode:checked { background: @fill; border-color: @fill; color: white; }
QDockWidget { titlebar-close-icon: none; titlebar-normal-icon: none; }
QStatusBar { background: @window; border-top: 1px solid @edge; color: @secondary; }
QStatusBar::item { border: none; }
QStatusBar QLabel { color: @secondary; padding: 0 8px; }
QMenuBar { background: @window; }
QMenuBar::item { padding: 4px 8px; background: transparent; border-radius: 3px; }
QMenuBar::item:selected { background: @selected; }
QMenu { background: @window; border: 1px solid @inner; padding: 4px; }
QMenu::item { padding: 4px 24px 4px 24px; border-radius: 3px; }
QMenu::item:selected { background: @selected; color: @text; }
QMenu::item:disabled { color: @disabled; }
QMenu::separator { height: 1px; background: @inner; margin: 4px 6px; }
QTabBar::tab { background: transparent; border: none; border-top: 2px solid transparent; padding: 4px 12px; color: @secondary; }
QTabBar::tab:selected { background: @view; border-top-color: @accent; color: @text; }
QTabBar::tab:hover { color: @text; }
QTabWidget::pane { border: none; }
QHeaderView::section { background: @window; color: @secondary; border: none; border-bottom: 1px solid @inner; padding: 3px 6px; }
QTreeView, QTableView, QListView { background: @view; alternate-background-color: @alternate; border: none;
  selection-background-color: @selected; selection-color: @text; outline: none; gridline-color: @inner; }
QToolTip { background: @window; color: @text; border: 1px solid @inner; padding: 3px; }
QLineEdit, QSpinBox, QDoubleSpinBox { background: @view; border: 1px solid @inner; border-radius: 3px; padding: 2px 5px; }
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus { border-color: @accent; }
QScrollArea { border: none; background: @view; }
)");
  const struct {
    const char* name;
    const QColor& color;
  } names[] = {{"@edge", c.outerEdge},      {"@inner", c.innerLine},
               {"@accent", c.accentLine},   {"@fill", c.accentFill},
               {"@selected", c.selectedRow}, {"@window", c.window},
               {"@view", c.view},           {"@alternate", c.alternateRow},
               {"@button", c.button},       {"@secondary", c.secondaryText},
               {"@disabled", c.disabledText}, {"@text", c.text}};
  for (const auto& entry : names) {
    sheet.replace(QLatin1String(entry.name), entry.color.name());
  }
  return sheet;
}

}  // namespace pitchboard::ui
