// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The whole window with a real match and files in a folder of its own, for tests of sessions.

#include <QAction>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>

#include <ui/base/notice_bar.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "studio_rig.h"

namespace session_rig {

using namespace pitchboard;
using namespace pitchboard::ui;

struct Studio : studio_rig::Studio {
  explicit Studio(std::uint64_t playTo = 600) {
    window.recording()->setFolder(folder.filePath(QStringLiteral("new/recordings")));
    if (playTo == 0) return;
    controller.open(link::loadScenario("match-3v3").value(), true);
    controller.runTo(playTo);
  }
  bool played(std::uint64_t tick) const {
    return controller.frame() && controller.frame()->snapshot.tick >= tick;
  }
  QToolButton* record() const { return window.findChild<QToolButton*>(QStringLiteral("record")); }
  QAction* action(const char* name) const {
    return window.findChild<QAction*>(QLatin1String(name));
  }
  QString notice() const { return window.notices()->text(); }
  /// Records the next `ticks` of the match, with a bookmark; the file.
  QString recorded(std::uint64_t ticks) {
    QSignalSpy saved(window.recording(), &SessionRecording::saved);
    QTest::mouseClick(record(), Qt::LeftButton, {}, {8, 8});
    const std::uint64_t to = controller.frame()->snapshot.tick + ticks;
    controller.runTo(to);
    if (!QTest::qWaitFor([this, to] { return played(to); }, 20'000)) return {};
    window.shown()->addBookmark(QStringLiteral("recorded"));
    QTest::mouseClick(record(), Qt::LeftButton, {}, {8, 8});
    if (!QTest::qWaitFor([&saved] { return saved.size() == 1; }, 20'000)) return {};
    return saved.at(0).at(0).toString();
  }
};

/// With its button, as a person does.
inline void closeNotice(MainWindow& window) {
  const auto buttons = window.notices()->findChildren<QAbstractButton*>();
  for (auto* button : buttons) {
    const bool closes = qobject_cast<QToolButton*>(button) != nullptr ||
                        button->text() == QStringLiteral("Close") ||
                        button->text() == QStringLiteral("Not now");
    if (button->isVisible() && closes) {
      QTest::mouseClick(button, Qt::LeftButton);
      break;
    }
  }
  QCoreApplication::processEvents();
}

}  // namespace session_rig
