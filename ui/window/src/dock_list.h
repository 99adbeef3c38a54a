// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one list of docks. A dock is a pair of files with a make function, and two lines in
// dock_list.cpp: how it is made from the parts of the window, and where it stands. Menus, saved
// layouts and "Reset layout" follow from it.

#include <QString>
#include <Qt>
#include <span>

class QWidget;

namespace pitchboard::ui {

struct StudioParts;

struct DockInfo {
  const char* id;  ///< in saved layouts: never change it
  const char* title;
  Qt::DockWidgetArea area;  ///< docks of the bottom are tabbed together
  bool shownAtFirst;
  QWidget* (*make)(const StudioParts& parts, QWidget* parent);
  bool ownRow = false;  ///< bottom: below the tabs, without a title while docked
  int height = 0;       ///< px of the mock that it needs while it is open; 0: what it is given
};

std::span<const DockInfo> studioDocks();

}  // namespace pitchboard::ui
