// SPDX-License-Identifier: GPL-3.0-or-later
// The panel Explore: a moment is explored from the menu and from the panel, in Simulate, while
// looking back, in Replay and in Live; the field shows what was found.

#include <QDockWidget>
#include <QGraphicsView>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QSlider>

#include <ui/explore/explorer.h>
#include <ui/field/field_view.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>

#include "../support/menu_entry.h"
#include "../support/robot_keys.h"
#include "heat_item.h"
#include "live_rig.h"
#include "session_rig.h"

namespace tst_explore_panel {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::Studio;

namespace {

constexpr int patience_ms = 60'000;

struct Panel {
  explicit Panel(MainWindow& of)
      : window(of),
        dock(of.findChild<QDockWidget*>(QStringLiteral("explore"))),
        explorer(of.findChild<Explorer*>()) {}

  template <class T>
  T* find(const char* name) const {
    T* found = dock->findChild<T*>(QLatin1String(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  QString text(const char* label) const { return find<QLabel>(label)->text(); }
  void press(const char* button) const {
    QTest::mouseClick(find<QPushButton>(button), Qt::LeftButton);
  }
  bool hasResult() const {
    return explorer->found() != nullptr && explorer->found()->result.rollouts > 0;
  }
  template <class Item>
  Item* item() const {
    auto* view = window.field()->findChild<QGraphicsView*>();
    for (QGraphicsItem* one : view->scene()->items()) {
      if (auto* found = dynamic_cast<Item*>(one); found != nullptr && found->isVisible()) {
        return found;
      }
    }
    return nullptr;
  }

  MainWindow& window;
  QDockWidget* dock;
  Explorer* explorer;
};

/// Opens the menu and clicks the entry.
void clickInMenu(MainWindow& window, const char* menu, const char* entry) {
  QMenuBar* bar = window.menuBar();
  QAction* top = menu_entry::called(bar->actions(), QLatin1String(menu));
  QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(top).center());
  QAction* action = menu_entry::called(top->menu()->actions(), QLatin1String(entry));
  QVERIFY(action != nullptr);
  QTest::mouseClick(top->menu(), Qt::LeftButton, {}, top->menu()->actionGeometry(action).center());
}

}  // namespace

class TestExplorePanel : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aMomentOfAMatchIsExplored() {
    Studio s(900);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(900), patience_ms);
    Panel panel(s.window);
    QVERIFY(!panel.dock->isVisible());
    clickInMenu(s.window, "Timeline", "Explore from this moment");
    QVERIFY(panel.dock->isVisible());
    QVERIFY(panel.explorer->isRunning());
    QVERIFY(panel.find<QPushButton>("exploreCancel")->isVisible());
    QTRY_VERIFY_WITH_TIMEOUT(panel.hasResult(), patience_ms);
    QCOMPARE(panel.explorer->found()->time, 15.0);
    QVERIFY(panel.text("exploreNotes").contains(QStringLiteral("true positions")));
    QVERIFY(panel.text("exploreGoals").contains(QStringLiteral("Blue scores")));
    QVERIFY(panel.item<HeatItem>() != nullptr);
    panel.press("exploreCancel");
    QVERIFY(!panel.explorer->isRunning());
    QVERIFY(panel.hasResult());

    // Other times of the ball.
    auto* slider = panel.find<QSlider>("exploreSecond");
    QCOMPARE(slider->value(), 5);
    QCOMPARE(panel.text("exploreSecondText"), QStringLiteral("Ball in 5 s"));
    const QImage before = s.window.field()->grab().toImage();
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_End);
    QCOMPARE(panel.text("exploreSecondText"), QStringLiteral("Ball in 30 s"));
    QVERIFY(s.window.field()->grab().toImage() != before);

    // The layer hides it, Clear forgets it.
    auto* layer = s.window.findChild<QAction*>(QStringLiteral("layer.exploration"));
    layer->trigger();
    QVERIFY(panel.item<HeatItem>() == nullptr);
    layer->trigger();
    QVERIFY(panel.item<HeatItem>() != nullptr);
    panel.press("exploreClear");
    QVERIFY(panel.item<HeatItem>() == nullptr);
    QVERIFY(panel.explorer->found() == nullptr);
  }

  void anotherMatchForgetsWhatWasFound() {
    Studio s(900);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(900), patience_ms);
    Panel panel(s.window);
    panel.dock->show();
    panel.press("exploreStart");
    QTRY_VERIFY_WITH_TIMEOUT(panel.hasResult(), patience_ms);
    s.controller.open(link::loadScenario("one-robot").value(), true);
    QTRY_VERIFY(panel.explorer->found() == nullptr && !panel.explorer->isRunning());
  }

  void thePastAndARecordingAreExplored() {
    Studio s(900);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(900), patience_ms);
    Panel panel(s.window);
    panel.dock->show();
    s.window.shown()->seek(10.0);
    QVERIFY(s.window.shown()->isLookingBack());
    panel.press("exploreStart");
    QTRY_VERIFY_WITH_TIMEOUT(panel.hasResult(), patience_ms);
    QCOMPARE(panel.explorer->found()->time, 10.0);
    QVERIFY(panel.text("exploreNotes").contains(QStringLiteral("true positions")));
    s.window.shown()->goLive();
    const QString session = s.recorded(60);
    QVERIFY(!session.isEmpty());
    s.window.openSession(session);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    QTRY_VERIFY(panel.explorer->found() == nullptr);
    s.window.shown()->seek(s.window.shown()->available()->end);
    QTRY_VERIFY(s.window.replay()->frame() && s.window.replay()->frame()->robots.size() == 6);
    panel.press("exploreStart");
    QTRY_VERIFY_WITH_TIMEOUT(panel.hasResult(), patience_ms);
    QVERIFY(panel.text("exploreNotes").contains(QStringLiteral("where they believe they are")));
    panel.press("exploreCancel");
  }

  void liveRobotsAreExplored() {
    Studio s(0);
    const link::LiveOptions options = live_rig::options();
    s.window.live()->setOptions(options);
    s.window.showSource(SourceKind::Live);
    QTRY_VERIFY(!s.window.live()->details().network.ports.empty());
    Panel panel(s.window);
    panel.dock->show();
    QVERIFY(!panel.find<QPushButton>("exploreStart")->isEnabled());
    const live_rig::Robot one(options, 1), two(options, 2);
    QTRY_VERIFY(one.sendMessage() && two.sendMessage() && s.window.live()->frame() &&
                s.window.live()->frame()->robots.size() == 2);
    QTRY_VERIFY(panel.find<QPushButton>("exploreStart")->isEnabled());
    panel.press("exploreStart");
    QVERIFY2(panel.explorer->isRunning(), qPrintable(panel.explorer->problem()));
    QTRY_VERIFY_WITH_TIMEOUT(panel.hasResult(), patience_ms);
    QVERIFY(panel.text("exploreNotes").contains(QStringLiteral("Only one team is known")));
    QVERIFY(panel.text("exploreNotes").contains(QStringLiteral("kid-size")));
    QVERIFY(panel.item<HeatItem>() != nullptr);
    panel.press("exploreCancel");
    QVERIFY(!one.received() && !two.received());
  }
};

PITCHBOARD_GUI_TEST(TestExplorePanel)

}  // namespace tst_explore_panel

#include "tst_explore_panel.moc"
