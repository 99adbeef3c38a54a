// SPDX-License-Identifier: GPL-3.0-or-later
#include "menu_actions.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>

namespace pitchboard::ui {
namespace {

QString plain(QString text) {
  return text.remove(QLatin1Char('&'));
}

void collect(QMenu* menu, const QString& path, std::vector<MenuAction>& all) {
  // Many menus fill themselves, and tick their entries, when they are about to be seen.
  emit menu->aboutToShow();
  for (QAction* action : menu->actions()) {
    if (action->menu() != nullptr)
      collect(action->menu(), path + QStringLiteral(": ") + plain(action->text()), all);
    else if (!action->isSeparator() && !action->text().isEmpty())
      all.push_back({path, plain(action->text()), action});
  }
}

}  // namespace

std::vector<MenuAction> menuActions(const QMenuBar& bar) {
  std::vector<MenuAction> all;
  for (QAction* top : bar.actions()) {
    if (top->menu() != nullptr) collect(top->menu(), plain(top->text()), all);
  }
  return all;
}

}  // namespace pitchboard::ui
