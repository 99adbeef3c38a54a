// SPDX-License-Identifier: GPL-3.0-or-later
// How often the studio paints.
#include <QtTest>

#include <ui/base/beat.h>
#include <ui/sources/match_controller.h>
#include <ui/window/main_window.h>

#include "../studio_rig.h"

namespace tst_quiet {

using namespace pitchboard;
using namespace pitchboard::ui;
using studio_rig::Studio;

namespace {

/// What the widgets of a window are asked to do.
class Asked : public QObject {
 public:
  explicit Asked(QWidget* window) : m_window(window) { qApp->installEventFilter(this); }
  int paints = 0, repaints = 0;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::UpdateRequest && watched == m_window) ++repaints;
    if (event->type() == QEvent::Paint) ++paints;
    return false;
  }

 private:
  QWidget* m_window;
};

}  // namespace

class TestQuiet : public QObject {
  Q_OBJECT

 private slots:
  void whatIsPlayedIsPaintedWithTheBeat() {
    Studio studio;
    studio.controller.open(*link::loadScenario("match-3v3"), false);
    QTRY_VERIFY(studio.controller.frame() && studio.controller.frame()->snapshot.time > 0.5);
    Beat& beat = Beat::display();
    const quint64 before = beat.beats();
    const Asked asked(&studio.window);
    QTRY_VERIFY_WITH_TIMEOUT(beat.beats() >= before + 60, 30'000);
    const auto beats = static_cast<int>(beat.beats() - before);
    QVERIFY(asked.paints > beats);
    // Some views put a stroke off by themselves.
    QVERIFY2(asked.repaints <= beats + beats / 4,
             qPrintable(QStringLiteral("%1 repaints in %2 beats").arg(asked.repaints).arg(beats)));
  }
};

PITCHBOARD_GUI_TEST(TestQuiet)

}  // namespace tst_quiet

#include "tst_quiet.moc"
