// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio in a window of a chosen size, with settings of its own.

#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

#include <ui/base/notice_bar.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "alarms.h"
#include "menu_actions.h"
#include "plot_page.h"
#include "studio_rig.h"

namespace window_rig {

using namespace pitchboard;
using namespace pitchboard::ui;

struct Studio : studio_rig::Studio {
  using studio_rig::Studio::Studio;
  /// A match of five seconds, paused.
  void play() {
    controller.open(link::loadScenario("match-3v3").value(), true);
    controller.runTo(300);
    QTRY_VERIFY(controller.frame() && controller.frame()->snapshot.tick == 300);
  }
  template <class Widget>
  Widget* find(const char* name) {
    return window.findChild<Widget*>(QLatin1String(name));
  }
  ShownMoment* timeline() { return window.shown(); }
  QAction* menuAction(const QString& text) {
    for (const MenuAction& each : menuActions(*window.menuBar())) {
      if (each.text.startsWith(text)) return each.action;
    }
    return nullptr;
  }
};

}  // namespace window_rig
