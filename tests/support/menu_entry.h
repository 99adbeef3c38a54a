// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Entries of menus by their words, as a person finds them: the mark of a key (&) does not count.
// What is not there is null. UI thread.

#include <QAction>
#include <QMenu>
#include <QStringList>
#include <algorithm>

namespace menu_entry {

inline QString words(const QAction* action) {
  return action->text().remove(QLatin1Char('&'));
}

/// The first that is called so.
inline QAction* called(const QList<QAction*>& actions, const QString& text) {
  const auto found = std::ranges::find(actions, text, words);
  return found != actions.end() ? *found : nullptr;
}
/// The first whose words begin so.
inline QAction* beginning(const QList<QAction*>& actions, const QString& text) {
  const auto found = std::ranges::find_if(
      actions, [&](const QAction* action) { return words(action).startsWith(text); });
  return found != actions.end() ? *found : nullptr;
}

/// Down from a menu bar or a menu by these words. The first menu on the way fills itself as when it
/// is opened.
inline QAction* downFrom(const QWidget* menu, const QStringList& way) {
  QAction* found = nullptr;
  for (const QString& text : way) {
    if (menu == nullptr) return nullptr;
    const bool first = found == nullptr;
    found = called(menu->actions(), text);
    if (found == nullptr) return nullptr;
    if (first && found->menu() != nullptr) emit found->menu()->aboutToShow();
    menu = found->menu();
  }
  return found;
}

}  // namespace menu_entry
