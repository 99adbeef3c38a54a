// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio in a window of a chosen size (an invalid one: its own), with settings and a folder of
// its own; its robots think inside.

#include <QDockWidget>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>

namespace studio_rig {

struct Studio {
  QTemporaryDir folder;
  QSettings settings{folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat};
  pitchboard::ui::MatchController controller;
  pitchboard::ui::MainWindow window;

  explicit Studio(QSize size = {1280, 800}) : Studio(options(), size) {}
  explicit Studio(const pitchboard::link::MatchOptions& how, QSize size = {1280, 800})
      : controller(how), window(&controller, &settings) {
    if (size.isValid()) window.resize(size);
    window.show();
  }
  static pitchboard::link::MatchOptions options() {
    pitchboard::link::MatchOptions made;
    made.cognition = pitchboard::link::Cognition::Inline;
    return made;
  }
};

/// The same with a panel in front.
struct PanelStudio : Studio {
  QDockWidget* dock;

  explicit PanelStudio(const char* panel)
      : dock(window.findChild<QDockWidget*>(QLatin1String(panel))) {
    dock->show();
    dock->raise();
  }
  template <class Widget>
  Widget* find(const char* name) const {
    auto* found = dock->findChild<Widget*>(QLatin1String(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  /// Opens a session in Replay, and waits until it is shown.
  void open(const QString& session) {
    constexpr int patience_ms = 30'000;
    window.openSession(session);
    QTRY_VERIFY_WITH_TIMEOUT(
        window.shown()->source() == window.replay() && window.replay()->path() == session,
        patience_ms);
  }
};

}  // namespace studio_rig
