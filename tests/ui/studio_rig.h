// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio in a window of a chosen size (an invalid one: its own), with settings and a folder of
// its own; its robots think inside.

#include <QSettings>
#include <QTemporaryDir>

#include <ui/sources/match_controller.h>
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

}  // namespace studio_rig
