// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every action that the menu bar offers, with the menus that lead to it: for the list of shortcuts
// and for searching actions by text. UI thread only.

#include <QPointer>
#include <QString>
#include <vector>

class QAction;
class QMenuBar;

namespace pitchboard::ui {

struct MenuAction {
  QString menu;  ///< "View: Field layers"
  QString text;  ///< "Grid", without its mnemonic
  QPointer<QAction> action;
};

/// In the order of the menus, which fill themselves as if they were opened.
std::vector<MenuAction> menuActions(const QMenuBar& bar);

}  // namespace pitchboard::ui
