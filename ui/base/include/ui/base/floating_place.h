// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where panels and cards that begin to float are placed. UI thread.

#include <QDockWidget>
#include <QMainWindow>

#include <ui/base/theme.h>

namespace pitchboard::ui {

/// Moves a floating panel over the field, right of the field's tools, and below and right of the
/// panels that float there already. It takes at most half of the field's width and three quarters
/// of its height.
inline void moveBesideTools(QDockWidget* panel) {
  const auto* window = qobject_cast<QMainWindow*>(panel->parentWidget());
  if (window == nullptr || window->centralWidget() == nullptr) return;
  const QWidget* centre = window->centralWidget();
  const int step = scaled(panel, 28);
  QPoint place = centre->mapToGlobal(QPoint(scaled(panel, 48), scaled(panel, 44)));
  const auto isTaken = [&place, panel, window] {
    for (const auto* other : window->findChildren<QDockWidget*>()) {
      if (other != panel && other->isFloating() && other->isVisible() && other->pos() == place)
        return true;
    }
    return false;
  };
  while (isTaken()) place += QPoint(step, step);
  const QSize most(centre->width() / 2, centre->height() * 3 / 4);
  panel->resize(panel->size().boundedTo(most).expandedTo(panel->minimumSizeHint()));
  panel->move(place);
}

}  // namespace pitchboard::ui
