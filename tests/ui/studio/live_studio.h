// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio in Live on ports of its own, for tests that send what robots send.

#include <QGraphicsView>
#include <QLabel>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include <ui/base/notice_bar.h>
#include <ui/base/scoreboard_state.h>
#include <ui/plots/plots_dock.h>
#include <ui/robots/robot_card.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/window/main_window.h>

#include "live_rig.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "scoreboard.h"
#include "studio_rig.h"

namespace live_studio {

using namespace pitchboard;
using namespace pitchboard::ui;

struct Studio : studio_rig::Studio {
  link::LiveOptions options = live_rig::options();

  Studio() { live()->setOptions(options); }
  LiveController* live() { return window.live(); }
  void change(const std::function<void(link::LiveOptions&)>& edit) {
    edit(options);
    live()->setOptions(options);
  }
  /// Through the button, as a person does.
  void goLive() {
    for (auto* button : window.findChildren<QToolButton*>(QStringLiteral("mode"))) {
      if (button->text() == QStringLiteral("Live")) QTest::mouseClick(button, Qt::LeftButton);
    }
    QTRY_VERIFY(live()->frame());
    QTRY_COMPARE(bound(), link::portsOf(options)->size());
  }
  std::size_t bound() {
    std::size_t count = 0;
    for (const auto& port : live()->details().network.ports) count += port.bound ? 1 : 0;
    return count;
  }
  std::size_t robots() { return live()->frame()->robots.size(); }
  const link::RobotFrame& robot(std::size_t i = 0) { return live()->frame()->robots.at(i); }
  const telemetry::LinkHealth& health(std::size_t i = 0) { return *robot(i).link; }
  QList<RobotCard*> cards() { return window.findChild<RobotsDock*>()->cards(); }
  /// The key that the robot of a card has now.
  RobotKey keyOn(qsizetype card) {
    const link::RobotFrame* shown = live()->frame()->robot(cards()[card]->state().id);
    return shown != nullptr ? shown->key : RobotKey{};
  }
  QGraphicsView* canvas() { return window.field()->findChild<QGraphicsView*>(); }
  Scoreboard* scoreboard() { return window.findChild<Scoreboard*>(QStringLiteral("scoreboard")); }
  QString label(const char* name) { return window.findChild<QLabel*>(QLatin1String(name))->text(); }
};

}  // namespace live_studio
