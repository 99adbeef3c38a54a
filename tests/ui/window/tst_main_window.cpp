// SPDX-License-Identifier: GPL-3.0-or-later
// The window as a person uses it: real clicks and keys on a real match.
#include <QComboBox>
#include <QDockWidget>
#include <QGraphicsView>
#include <QLabel>
#include <QMenuBar>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolBar>
#include <QToolButton>
#include <QUndoStack>
#include <QtTest>
#include <algorithm>

#include <ui/base/notice_bar.h>
#include <ui/field/field_view.h>
#include <ui/robots/robot_card.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "../support/menu_entry.h"
#include "../support/real_time_robot.h"
#include "../support/segment_keys.h"
#include "studio_rig.h"

namespace tst_main_window {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestMainWindow : public QObject {
  Q_OBJECT

  struct Studio : studio_rig::Studio {
    explicit Studio(bool paused = true, const link::MatchOptions& how = options(),
                    const char* scenario = "match-3v3")
        : studio_rig::Studio(how) {
      controller.open(link::loadScenario(scenario).value(), paused);
      window.files()->showCurrent(QStringLiteral("match-3v3"));
    }
    QWidget* button(const char* action) {
      auto* bar = window.findChild<QToolBar*>(QStringLiteral("transportBar"));
      return bar->widgetForAction(window.findChild<QAction*>(QLatin1String(action)));
    }
    QDockWidget* dock(const char* id) { return window.findChild<QDockWidget*>(QLatin1String(id)); }
    /// Opens the menu of this entry and clicks on it; whether it was checked before.
    bool chooseInMenu(const QString& text) {
      QAction* action = menuAction(text);
      for (QMenu* menu : window.findChildren<QMenu*>()) {
        if (!action || !menu->actions().contains(action)) continue;
        menu->popup(window.mapToGlobal(QPoint(50, 50)));
        if (!QTest::qWaitForWindowExposed(menu)) return false;
        const bool was = action->isChecked();
        QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
        return was;
      }
      return false;
    }
    QAction* menuAction(const QString& text) {
      return menu_entry::beginning(window.findChildren<QAction*>(), text);
    }
  };

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void theToolBarPlaysPausesAndSteps() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    QTest::mouseClick(s.button("step"), Qt::LeftButton);
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(1));
    QTest::mouseClick(s.button("play"), Qt::LeftButton);
    QTRY_VERIFY(s.controller.frame()->snapshot.tick > 10);
    QTest::mouseClick(s.button("play"), Qt::LeftButton);
    QVERIFY(s.controller.isPaused());
    QTRY_VERIFY(s.controller.frame()->paused);
    QTest::mouseClick(s.button("restart"), Qt::LeftButton);
    QTRY_VERIFY(s.controller.frame());
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(0));
  }

  void theSpeedBoxSetsTheSpeed() {
    Studio s(false);
    auto* speed = s.window.findChild<QComboBox*>(QStringLiteral("speed"));
    speed->setFocus();
    QTest::keyClick(speed, Qt::Key_End);
    QCOMPARE(s.controller.speed(), link::MatchRunner::unlimitedSpeed);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick > 2000);
    for (int i = 0; i < speed->count(); ++i) QTest::keyClick(speed, Qt::Key_Up);
    QCOMPARE(s.controller.speed(), 0.1);
  }

  void theChooserOpensAScenario() {
    Studio s;
    auto* chooser = s.window.findChild<QComboBox*>(QStringLiteral("scenarioChooser"));
    QCOMPARE(chooser->currentData().toString(), QStringLiteral("match-3v3"));
    const int other = chooser->findData(QStringLiteral("one-robot"));
    QVERIFY(other > 0);
    emit chooser->activated(other);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->robots.size() == 1);
    QCOMPARE(chooser->currentData().toString(), QStringLiteral("one-robot"));
  }

  void aBadFileIsANoticeAndTheMatchGoesOn() {
    Studio s;
    const QString path = s.folder.filePath(QStringLiteral("bad.json"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{ \"robots\": 3 }");
    file.close();
    s.window.files()->open(path);
    QVERIFY(s.window.notices()->isVisible());
    QVERIFY(s.window.notices()->text().contains(QStringLiteral("bad.json")));
    QVERIFY(s.controller.isOpen() || s.controller.isOpening());
    const auto buttons = s.window.notices()->findChildren<QToolButton*>();
    const auto close = std::ranges::find_if(buttons, [](const QToolButton* button) {
      return button->toolTip() == QStringLiteral("Close this notice");
    });
    QVERIFY(close != buttons.end());
    QTest::mouseClick(*close, Qt::LeftButton);
    QVERIFY(!s.window.notices()->isVisible());
  }

  void aSavedMomentOpensAgain() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    const QString path = s.folder.filePath(QStringLiteral("moment.json"));
    s.window.files()->save(path);
    s.window.files()->open(path);
    QVERIFY2(s.window.notices()->text().startsWith(QStringLiteral("Opened “moment”.")),
             qPrintable(s.window.notices()->text()));
    auto* chooser = s.window.findChild<QComboBox*>(QStringLiteral("scenarioChooser"));
    QCOMPARE(chooser->currentData().toString(), path);
    s.window.files()->save(QStringLiteral("/nonexistent/folder/x.json"));
    QVERIFY(!s.window.notices()->text().isEmpty());
  }

  // How separate processes keep time, chosen in the menu; the frames say what holds.
  void theMenuSwitchesFreeRunningAndLockStep() {
    const QString entry = QStringLiteral("Robot processes run freely");
    link::MatchOptions separate;
    separate.cognition = link::Cognition::Separate;
    separate.keyBase = testKeyBase();
    separate.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    {
      Studio s(false, separate, "one-robot");
      const auto inLockStep = [&s] {
        const FramePtr frame = s.controller.frame();
        return frame && frame->inLockStep;
      };
      QTRY_VERIFY_WITH_TIMEOUT(inLockStep(), 30'000);
      QVERIFY(!s.chooseInMenu(entry));
      QCOMPARE(s.controller.pace(), link::RobotsPace::Free);
      QTRY_VERIFY_WITH_TIMEOUT(!inLockStep(), 30'000);
      QVERIFY(s.chooseInMenu(entry));
      QCOMPARE(s.controller.pace(), link::RobotsPace::LockStep);
      QTRY_VERIFY_WITH_TIMEOUT(inLockStep(), 30'000);
    }
    removeSegment(separate.keyBase.value() + 100);
    // Processes inside the studio go in lock-step: there is nothing to choose.
    Studio inside;
    QVERIFY(!inside.chooseInMenu(entry));
    QVERIFY(!inside.menuAction(entry)->isEnabled());
    QCOMPARE(inside.controller.pace(), link::RobotsPace::LockStep);
  }

  void theStatusBarSaysWhetherAProcessIsWaitedFor() {
    const QTemporaryDir folder;
    link::MatchOptions separate;
    separate.cognition = link::Cognition::Separate;
    separate.keyBase = testKeyBase();
    separate.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    {
      Studio s(false, separate, "one-robot");
      auto* label = s.window.findChild<QLabel*>(QStringLiteral("statusProcesses"));
      QTRY_VERIFY_WITH_TIMEOUT(label->text().endsWith(QStringLiteral("in lock-step")), 30'000);
      // It says so while a past moment is shown, too.
      QTRY_VERIFY_WITH_TIMEOUT(s.controller.frame()->snapshot.tick > 60, 30'000);
      const auto* pace = s.window.findChild<QLabel*>(QStringLiteral("statusPace"));
      s.window.shown()->seek(0.5);
      QTRY_VERIFY(pace->text().startsWith(QStringLiteral("Viewing 00:00")));
      QVERIFY2(label->text().endsWith(QStringLiteral("in lock-step")), qPrintable(label->text()));
      s.window.shown()->goLive();
      s.controller.open(realTimeRobot(folder));
      QTRY_VERIFY_WITH_TIMEOUT(label->text().endsWith(QStringLiteral("running freely")), 30'000);
    }
    removeSegment(separate.keyBase.value() + 100);
  }

  void theMenuUndoes() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    s.controller.edits()->removeRobots({RobotId{1}});
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(5));
    QTRY_VERIFY(s.controller.edits()->undoStack()->canUndo());  // the match has reported it
    s.menuAction(QStringLiteral("Undo"))->trigger();
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(6));
    s.menuAction(QStringLiteral("Redo"))->trigger();
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(5));
  }

  void cardsComeGoAndSelect() {
    Studio s;
    const auto cards = [&s] { return s.window.findChildren<RobotCard*>(); };
    QTRY_COMPARE(cards().size(), qsizetype(6));
    QTest::mouseClick(cards()[2], Qt::LeftButton, {}, QPoint(60, 60));
    QVERIFY(cards()[2]->isSelected());
    QTest::mouseClick(cards()[3], Qt::LeftButton, Qt::ControlModifier, QPoint(60, 60));
    QVERIFY(cards()[2]->isSelected() && cards()[3]->isSelected());
    s.controller.edits()->removeRobots({RobotId{1}});
    QTRY_COMPARE(cards().size(), qsizetype(5));
  }

  void aCollapsedCardStaysWithItsRobot() {
    Studio s;
    const auto cards = [&s] { return s.window.findChildren<RobotCard*>(); };
    QTRY_COMPARE(cards().size(), qsizetype(6));
    cards()[2]->setCollapsed(true);
    const RobotUid id = cards()[2]->state().id;
    s.controller.edits()->removeRobots(s.controller.frame()->slotsOf({cards()[0]->state().id}));
    QTRY_COMPARE(cards().size(), qsizetype(5));
    QCOMPARE(cards()[1]->state().id, id);
    QVERIFY(cards()[1]->isCollapsed());
    QVERIFY(!cards()[2]->isCollapsed());
  }

  void theThemeSwitches() {
    Studio s;
    s.menuAction(QStringLiteral("Light"))->trigger();
    QVERIFY(!isDarkTheme());
    const QImage light = s.window.grab().toImage();
    s.menuAction(QStringLiteral("Dark"))->trigger();
    QVERIFY(isDarkTheme());
    QVERIFY(s.window.grab().toImage() != light);
    QCOMPARE(s.settings.value(QStringLiteral("window/theme")).toInt(), 2);
  }

  void theLayoutIsSavedRestoredAndReset() {
    Studio s;
    QVERIFY(s.dock("robots")->isVisible());
    QVERIFY(!s.dock("noise")->isVisible());
    s.dock("robots")->close();
    s.dock("noise")->show();
    s.window.close();
    {
      MainWindow again(&s.controller, &s.settings);
      again.show();
      QVERIFY(!again.findChild<QDockWidget*>(QStringLiteral("robots"))->isVisible());
      QVERIFY(again.findChild<QDockWidget*>(QStringLiteral("noise"))->isVisible());
      again.resetLayout();
      QVERIFY(again.findChild<QDockWidget*>(QStringLiteral("robots"))->isVisible());
      QVERIFY(!again.findChild<QDockWidget*>(QStringLiteral("noise"))->isVisible());
    }
  }

  void garbageForALayoutGivesTheDefault() {
    Studio s;
    s.settings.setValue(QStringLiteral("window/layout"), QByteArray("no layout at all"));
    s.settings.setValue(QStringLiteral("window/geometry"), QByteArray("\x01\x02"));
    MainWindow again(&s.controller, &s.settings);
    again.show();
    QVERIFY(again.findChild<QDockWidget*>(QStringLiteral("robots"))->isVisible());
    QVERIFY(again.width() > 600);
  }
};

PITCHBOARD_GUI_TEST(TestMainWindow)

}  // namespace tst_main_window

#include "tst_main_window.moc"
