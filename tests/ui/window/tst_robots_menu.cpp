// SPDX-License-Identifier: GPL-3.0-or-later
// Robots by their cards and by the menu bar, in a whole window with real keys and clicks: whoever
// has no mouse can do the same, and the keys of the field act wherever robots were chosen.
#include <QComboBox>
#include <QContextMenuEvent>
#include <QDoubleSpinBox>
#include <QGraphicsView>
#include <QHelpEvent>
#include <QLineEdit>
#include <QMenuBar>
#include <QScrollBar>
#include <QSet>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolTip>
#include <QUndoStack>
#include <QtTest>

#include <simcore/world/action_codes.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>

#include "../support/menu_entry.h"
#include "../support/robot_keys.h"
#include "studio_rig.h"

namespace tst_robots_menu {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestRobotsMenu : public QObject {
  Q_OBJECT

  struct Studio : studio_rig::Studio {
    explicit Studio(int more = 0, QSize size = {1280, 800}) : studio_rig::Studio(size) {
      link::Scenario scenario = link::loadScenario("match-3v3").value();
      for (int i = 0; i < more; ++i) {
        link::ScenarioRobot robot;
        robot.identity.id = {7 + i};
        robot.identity.number = 4 + i;
        robot.pose = {{-4.0 + 0.5 * i, -2.5}, 0.0};
        scenario.robots.push_back(robot);
      }
      controller.open(scenario, true);
    }
    RobotsDock* dock() { return window.findChild<RobotsDock*>(); }
    QList<RobotCard*> cards() { return dock()->cards(); }
    /// Of the menu Robots.
    QAction* entry(const QStringList& path) {
      return menu_entry::downFrom(window.menuBar(), QStringList("Robots") + path);
    }
    bool trigger(const QStringList& path) {
      QAction* found = entry(path);
      if (found != nullptr) found->trigger();
      return found != nullptr;
    }
    Pose pose(int id) {
      const auto* robot = controller.frame()->robot(RobotId{id});
      return robot ? robot->pose : Pose{};
    }
  };

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void theMenuDoesWhatTheMouseDoes() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    QVERIFY(!s.entry({"Behaviour"}));  // of nobody
    QVERIFY(s.trigger({"Select", "B2"}));
    QCOMPARE(s.window.field()->selection(), std::vector{inSlot(2)});
    QVERIFY(s.entry({"Select", "B2"})->isChecked());
    QVERIFY(s.trigger({"Behaviour", "Keeper"}));
    QTRY_COMPARE(s.controller.frame()->robot(RobotId{2})->behaviour, std::string("keeper"));
    QVERIFY(s.entry({"Behaviour", "Keeper"})->isChecked());
    QVERIFY(s.trigger({"Order", "Kick left"}));
    QTRY_COMPARE(s.controller.frame()->robot(RobotId{2})->decided.value_or(-1), 5);
    QVERIFY(s.trigger({"Number", "9"}));
    QTRY_COMPARE(s.controller.frame()->robot(RobotId{2})->identity.number, 9);
    QTRY_COMPARE(s.window.field()->selection(), std::vector{inSlot(2)});
    // Cards stand in the order of numbers.
    QTRY_COMPARE(s.cards()[2]->state().name, QStringLiteral("B9"));
    QVERIFY(s.trigger({"Pose…"}));
    auto* x = s.window.field()->findChild<QDoubleSpinBox*>(QStringLiteral("x"));
    QVERIFY(x);
    x->setValue(-2.25);
    QTest::keyClick(x, Qt::Key_Return);
    QTRY_VERIFY(std::abs(s.pose(2).position.x + 2.25) < 1e-6);
    QVERIFY(s.trigger({"Blackboard…"}));
    auto* words = s.window.findChild<QLineEdit*>(QStringLiteral("variablesFilter"));
    QCOMPARE(words->text(), QStringLiteral("B9/"));
    QTRY_VERIFY(words->isVisible());
    QVERIFY(s.trigger({"Select", "All"}));
    QVERIFY(s.trigger({"Remove 6 robots"}));
    QTRY_VERIFY(s.controller.frame()->robots.empty());
    QVERIFY(s.trigger({"Add robot", "Red"}));
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(1));
    QVERIFY(s.trigger({"Ball to the centre mark"}));
    // The cards follow the match at a calm rate.
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QVERIFY(s.trigger({"Cards", "Collapse all"}));
    QVERIFY(s.cards()[0]->isCollapsed());
  }

  /// What belongs together stands together, and nothing is missing.
  void ordersAreGrouped() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    QVERIFY(s.trigger({"Select", "B2"}));
    QVERIFY(s.entry({"Order"}));
    QStringList groups{QString()};
    QSet<QString> offered;
    for (const QAction* action : s.entry({"Order"})->menu()->actions()) {
      if (action->isSeparator()) {
        groups << QString();
      } else {
        groups.back() += action->text() + QLatin1Char('|');
        offered << action->text();
      }
    }
    QCOMPARE(groups.size(), qsizetype(4));
    QVERIFY2(groups[0].startsWith("Kick right|Kick left|"), qPrintable(groups[0]));
    QVERIFY2(groups[1].startsWith("Walk forward, fast|Walk forward, slow|Walk backward, fast|"),
             qPrintable(groups[1]));
    QVERIFY2(groups[1].endsWith("Around the ball, left|Around the ball, right|"),
             qPrintable(groups[1]));
    for (const ActionInfo& action : knownActions) {
      const auto label = QString::fromUtf8(action.label.data(), qsizetype(action.label.size()));
      QVERIFY2(offered.contains(label.left(1).toUpper() + label.mid(1)), qPrintable(label));
    }
  }

  // A right click selects the card, as everywhere; of several selected ones it keeps all.
  void aRightClickSelectsTheCard() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    const auto rightClick = [&s](int index) {
      QTimer::singleShot(0, qApp, [] {
        QVERIFY(QApplication::activePopupWidget());
        QApplication::activePopupWidget()->close();
      });
      RobotCard* card = s.cards()[index];
      const QPoint at(60, 20);
      QContextMenuEvent asked(QContextMenuEvent::Mouse, at, card->mapToGlobal(at));
      QApplication::sendEvent(card, &asked);
    };
    s.window.field()->select({inSlot(1)});
    rightClick(1);
    QCOMPARE(s.window.field()->selection(), std::vector{inSlot(2)});
    s.window.field()->select({inSlot(1), inSlot(2)});
    rightClick(0);
    QCOMPARE(s.window.field()->selection(), (std::vector{inSlot(1), inSlot(2)}));
  }

  // Opened and used by keys alone.
  void theMenuOpensByKeys() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    QTest::keyClick(&s.window, Qt::Key_R, Qt::AltModifier);
    QTRY_VERIFY(qobject_cast<QMenu*>(QApplication::activePopupWidget()));
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QCOMPARE(menu->actions().front()->text(), QStringLiteral("Select"));
    QTest::keyClick(menu, Qt::Key_Escape);
  }

  void theKeyboardGoesFromCardToCard() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    s.window.activateWindow();
    RobotCard* first = s.cards()[0];
    first->setFocus();
    QTRY_VERIFY(first->hasFocus());
    QTest::keyClick(first, Qt::Key_Return);
    QCOMPARE(s.window.field()->selection(), std::vector{inSlot(1)});
    QVERIFY(first->hasFocus());
    QTest::keyClick(first, Qt::Key_Tab);
    QVERIFY(s.cards()[1]->hasFocus());
    QTest::keyClick(s.cards()[1], Qt::Key_Return, Qt::ControlModifier);
    QCOMPARE(s.window.field()->selection(), (std::vector{inSlot(1), inSlot(2)}));
    QVERIFY(s.cards()[1]->hasFocus());
    // A click with the mouse gives the keys to the field.
    QTest::mouseClick(s.cards()[2], Qt::LeftButton, {}, QPoint(8, 8));
    QVERIFY(!s.cards()[1]->hasFocus() && !s.cards()[2]->hasFocus());
  }

  void theFieldsKeysActOnWhatACardChose() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    auto* chooser = s.window.findChild<QComboBox*>(QStringLiteral("scenarioChooser"));
    auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    QVERIFY(canvas->hasFocus());
    QTest::mouseClick(chooser, Qt::LeftButton);
    chooser->hidePopup();
    QTRY_VERIFY(canvas->hasFocus());
    // From another part of the window to a card: the keys belong to the field.
    chooser->setFocus();
    QTest::mouseClick(s.cards()[1], Qt::LeftButton, {}, QPoint(60, 60));
    QVERIFY(canvas->hasFocus());
    const int slot = s.controller.frame()->robot(s.cards()[1]->state().id)->slot().value;
    const Pose before = s.pose(slot);
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Right,
                    Qt::ControlModifier | Qt::ShiftModifier);
    QTRY_VERIFY(std::abs(s.pose(slot).position.x - before.position.x - 0.1) < 1e-6);
  }

  void manyCardsCollapseByThemselves() {
    Studio few(2), many(3);  // eight and nine
    QTRY_COMPARE(few.cards().size(), qsizetype(8));
    QTRY_COMPARE(many.cards().size(), qsizetype(9));
    QVERIFY(!few.cards()[0]->isCollapsed() && many.cards()[0]->isCollapsed());
    // Whoever comes or goes, the others stay as they are.
    RobotCard* mine = many.cards()[4];
    QTest::mouseClick(mine, Qt::LeftButton, {}, QPoint(mine->width() - 10, 12));
    QVERIFY(!mine->isCollapsed());
    many.controller.edits()->removeRobots({RobotId{9}});
    QTRY_COMPARE(many.cards().size(), qsizetype(8));
    QVERIFY(many.cards()[0]->isCollapsed() && !mine->isCollapsed());
    few.controller.edits()->addRobot(TeamColor::Blue, {{0.0, 2.0}, 0.0}, 11);
    QTRY_COMPARE(few.cards().size(), qsizetype(9));
    for (const RobotCard* card : few.cards())
      QCOMPARE(card->isCollapsed(), card->state().number == 11);
  }

  // In a low window, with all cards open: none is cut, and each can be reached.
  void cardsThatDoNotFitScroll() {
    Studio s(6, {960, 600});
    QTRY_COMPARE(s.cards().size(), qsizetype(12));
    s.dock()->setAllCollapsed(false);
    QScrollBar* bar = s.dock()->verticalScrollBar();
    QTRY_VERIFY(bar->maximum() > 0);
    const QRect port = s.dock()->viewport()->rect();
    const auto placeOf = [&s](const QWidget* card) {
      return QRect(card->mapTo(s.dock()->viewport(), QPoint()), card->size());
    };
    for (const RobotCard* card : s.cards()) {
      QTRY_VERIFY2(card->height() >= card->minimumSizeHint().height(),
                   qPrintable(QStringLiteral("%1 of %2")
                                  .arg(card->height())
                                  .arg(card->minimumSizeHint().height())));
      QVERIFY(placeOf(card).left() >= port.left() && placeOf(card).right() <= port.right());
    }
    const RobotCard *first = s.cards().first(), *last = s.cards().last();
    QVERIFY(port.contains(placeOf(first)) && !port.intersects(placeOf(last)));
    // The wheel over a card.
    const QPoint at = placeOf(first).center();
    for (int i = 0; i < 100 && bar->value() < bar->maximum(); ++i) {
      QWheelEvent wheel(at, s.dock()->viewport()->mapToGlobal(at), {}, {0, -120}, Qt::NoButton, {},
                        Qt::NoScrollPhase, false);
      QCoreApplication::sendEvent(s.dock()->viewport(), &wheel);
    }
    QVERIFY(port.contains(placeOf(last)));
    QVERIFY(!port.intersects(placeOf(first)));
    // New frames leave the list where it is.
    const int there = bar->value();
    s.controller.runTo(60);
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(60));
    QTRY_VERIFY(s.cards().first()->state().detail.contains(QLatin1Char('m')));
    QCOMPARE(bar->value(), there);
    // Whoever is chosen elsewhere is seen here.
    QVERIFY(s.trigger({"Select", first->state().name}));
    QTRY_VERIFY(port.contains(placeOf(first)));
  }

  void aCardShowsNameAndTeam() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    s.controller.edits()->setBehaviour({RobotId{1}}, QStringLiteral("keeper"));
    QTRY_COMPARE(s.cards()[0]->state().subtitle, QStringLiteral("Keeper"));
    QVERIFY(s.cards()[0]->accessibleDescription().startsWith(QStringLiteral("Keeper, ")));
    RobotCard* card = s.cards()[0];
    const QPoint head(40, 12);
    QHelpEvent help(QEvent::ToolTip, head, card->mapToGlobal(head));
    QCoreApplication::sendEvent(card, &help);
    QVERIFY(QToolTip::text().startsWith(QStringLiteral("B1\nKeeper")));
  }

  void aMarkGoesWithADraggedCard() {
    Studio s;
    QTRY_COMPARE(s.cards().size(), qsizetype(6));
    auto* mark = s.dock()->findChild<QWidget*>(QStringLiteral("dropMark"));
    RobotCard* first = s.cards()[0];
    QTest::mousePress(first, Qt::LeftButton, {}, QPoint(60, 40));
    QTest::mouseMove(first, QPoint(60, 70));
    QVERIFY(mark->isVisible());
    QTest::mouseRelease(first, Qt::LeftButton, {}, QPoint(60, 70));
    QVERIFY(!mark->isVisible());
  }
};

PITCHBOARD_GUI_TEST(TestRobotsMenu)

}  // namespace tst_robots_menu

#include "tst_robots_menu.moc"
