// SPDX-License-Identifier: GPL-3.0-or-later
// How often the studio paints.
#include <QDockWidget>
#include <QMap>
#include <QtTest>

#include <ui/base/beat.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/shown_moment.h>
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
  QMap<QString, quint64> last;  ///< the beat in which a widget painted last

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::UpdateRequest && watched == m_window) ++repaints;
    if (event->type() != QEvent::Paint) return false;
    ++paints;
    const auto* widget = qobject_cast<QWidget*>(watched);
    const auto* parent = widget != nullptr ? widget->parentWidget() : nullptr;
    last[QLatin1String(watched->metaObject()->className()) + QLatin1Char(' ') +
         watched->objectName() +
         (parent != nullptr ? QStringLiteral(" in ") + parent->objectName() : QString())] =
        Beat::display().beats();
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

  void pausedPaintsNothing_data() {
    QTest::addColumn<bool>("past");
    QTest::newRow("now") << false;
    QTest::newRow("a past moment") << true;
  }
  void pausedPaintsNothing() {
    QFETCH(bool, past);
    Studio studio;
    studio.controller.open(*link::loadScenario("match-3v3"), true);
    studio.controller.runTo(300);
    QTRY_VERIFY(studio.controller.frame() && studio.controller.frame()->snapshot.tick == 300);
    for (auto* dock : studio.window.findChildren<QDockWidget*>()) dock->show();
    if (past) studio.window.shown()->seek(2.0);
    studio.window.field()->setFocus();
    Beat& beat = Beat::display();
    Asked asked(&studio.window);
    // There are a few beats a second, in which nobody finds anything new.
    constexpr quint64 quiet = 12;
    const quint64 from = beat.beats();
    QStringList busy;
    const auto rests = [&] {
      busy.clear();
      for (const auto& [name, at] : asked.last.asKeyValueRange()) {
        if (at + quiet > beat.beats()) busy << name;
      }
      return busy.isEmpty() && beat.beats() >= from + quiet;
    };
    QVERIFY2(QTest::qWaitFor(rests, 20'000), qPrintable(busy.join(QLatin1Char('\n'))));
  }
};

PITCHBOARD_GUI_TEST(TestQuiet)

}  // namespace tst_quiet

#include "tst_quiet.moc"
