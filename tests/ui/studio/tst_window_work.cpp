// SPDX-License-Identifier: GPL-3.0-or-later
// The window over a day at a match: looking back, finding things, notices, what stays where.

#include <QAccessible>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <QLayout>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QStatusBar>
#include <QTabBar>
#include <QTableView>
#include <QTextEdit>
#include <QToolButton>
#include <QUndoStack>
#include <QtTest>

#include <ui/base/notice_bar.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "../support/robot_keys.h"
#include "alarms.h"
#include "menu_actions.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "scoreboard.h"
#include "window_rig.h"

namespace tst_window_work {

using namespace pitchboard;
using namespace pitchboard::ui;
using window_rig::Studio;

class TestWindowWork : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void lookingBackForbidsEdits() {
    Studio s;
    s.play();
    s.controller.edits()->removeRobots({RobotId{1}});
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(5));
    s.timeline()->seek(2.0);
    QVERIFY(s.timeline()->isLookingBack());
    QVERIFY(!s.find<QToolButton>("editValues")->isEnabled());
    QVERIFY(!s.menuAction(QStringLiteral("Undo"))->isEnabled());
    s.controller.edits()->removeRobots({RobotId{2}});
    s.controller.edits()->writeVariable(RobotId{3}, QStringLiteral("DECISION_ACTION_A"), 5);
    QVERIFY2(s.window.notices()->text().contains(QStringLiteral("viewing the past")),
             qPrintable(s.window.notices()->text()));
    QTRY_COMPARE(s.controller.edits()->undoStack()->count(), 1);
    // Back at now the notice has no cause any more, and edits reach the match.
    QTest::mouseClick(s.find<QToolButton>("now"), Qt::LeftButton);
    QVERIFY(s.window.notices()->text().isEmpty());
    QVERIFY(s.find<QToolButton>("editValues")->isEnabled());
    s.menuAction(QStringLiteral("Undo"))->trigger();
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(6));
  }

  void aClickOnALogLineGoesThere() {
    Studio s;
    s.play();
    emit s.controller.logReceived({{2.0, "B1 decision", "here"}, {4.0, "B1 decision", "later"}});
    auto* dock = s.find<QDockWidget>("log");
    dock->raise();
    auto* table = dock->findChild<QTableView*>();
    QTRY_VERIFY(table->isVisible());
    const auto row = [table](const QString& text) {
      for (int r = 0; r < table->model()->rowCount(); ++r) {
        const QModelIndex cell = table->model()->index(r, 2);
        if (cell.data().toString() == text) return cell;
      }
      return QModelIndex();
    };
    table->scrollTo(row(QStringLiteral("here")));
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                      table->visualRect(row(QStringLiteral("here"))).center());
    QCOMPARE(s.timeline()->time(), 2.0);
    QCOMPARE(row(QStringLiteral("later")).data(Qt::ForegroundRole).value<QColor>(),
             theme().disabledText);
    s.timeline()->goLive();
    QVERIFY(!row(QStringLiteral("later")).data(Qt::ForegroundRole).isValid());
  }

  void searchFindsEverything() {
    Studio s;
    s.play();
    const auto find = [&s](const QString& words) {
      s.window.activateWindow();
      QTRY_VERIFY(s.window.isActiveWindow());
      QTest::keyClick(&s.window, Qt::Key_K, Qt::ControlModifier);
      auto* line = s.find<QLineEdit>("paletteSearch");
      QVERIFY(line);
      QTest::keyClicks(line, words);
      QTest::keyClick(line, Qt::Key_Return);
      QTRY_VERIFY(s.find<QDialog>("commandPalette") == nullptr);
    };
    find(QStringLiteral("R2"));
    const auto selected = s.window.findChild<RobotSelection*>()->ids();
    QCOMPARE(selected.size(), std::size_t(1));
    QCOMPARE(s.controller.frame()->robot(selected[0])->identity.number, 2);
    s.timeline()->seek(1.0);
    s.timeline()->addBookmark(QStringLiteral("odd sock"));
    s.timeline()->seek(3.0);
    find(QStringLiteral("odd sock"));
    QCOMPARE(s.timeline()->time(), 1.0);
    s.timeline()->goLive();
    find(QStringLiteral("b2 vision_ball_angle"));
    const auto* plots = s.window.findChild<PlotsDock*>();
    QVERIFY(plots->currentPage()->panes()[0]->hasCurve(
        variableCurve(QStringLiteral("B2/VISION_BALL_ANGLE"))));
    QVERIFY(s.find<QDockWidget>("log")->toggleViewAction()->isChecked());
    find(QStringLiteral("view log"));  // it was behind another tab
    QVERIFY(s.find<QDockWidget>("log")->toggleViewAction()->isChecked());
    find(QStringLiteral("view log"));
    QVERIFY(!s.find<QDockWidget>("log")->toggleViewAction()->isChecked());
  }

  void shortcutsAreSearched() {
    Studio s;
    s.menuAction(QStringLiteral("Keyboard shortcuts"))->trigger();
    auto* dialog = s.find<QDialog>("shortcuts");
    QVERIFY(dialog);
    const auto* table = dialog->findChild<QTableView*>();
    QStringList shown;
    for (int row = 0; row < table->model()->rowCount(); ++row) {
      shown << table->model()->index(row, 0).data().toString();
    }
    for (const MenuAction& each : menuActions(*s.window.menuBar())) {
      for (const QKeySequence& keys : each.action->shortcuts()) {
        QVERIFY2(!shown.filter(keys.toString()).isEmpty(), qPrintable(each.text));
      }
    }
    auto* words = dialog->findChild<QLineEdit*>(QStringLiteral("shortcutWords"));
    QTest::keyClicks(words, QStringLiteral("bookmark"));
    QCOMPARE(table->model()->rowCount(), 1);
    QCOMPARE(table->model()->index(0, 0).data().toString(), QStringLiteral("M, Ctrl+B"));
  }

  void theFieldAloneAndBack() {
    Studio s;
    s.play();
    QTest::keyClick(&s.window, Qt::Key_F11);
    QVERIFY(s.window.isFullScreen());
    QVERIFY(!s.find<QDockWidget>("robots")->isVisible());
    QVERIFY(!s.window.menuBar()->isVisible() && !s.window.statusBar()->isVisible());
    int boards = 0;
    for (const Scoreboard* board : s.window.findChildren<Scoreboard*>())
      boards += board->isVisible();
    QCOMPARE(boards, 1);
    // Keys do what they always do, also those of bars that are hidden.
    QWidget* canvas = s.window.findChild<FieldView*>()->focusProxy();
    canvas->setFocus();
    const bool paused = s.controller.isPaused();
    QTest::keyClick(canvas, Qt::Key_P, Qt::ControlModifier);
    QTRY_COMPARE(s.controller.isPaused(), !paused);
    QTest::keyClick(canvas, Qt::Key_P, Qt::ControlModifier);
    QTRY_COMPARE(s.controller.isPaused(), paused);
    QTest::keyClick(canvas, Qt::Key_1);
    QCOMPARE(s.window.findChild<RobotSelection*>()->ids().size(), std::size_t(1));
    QTest::keyClick(canvas, Qt::Key_Escape);
    QVERIFY(!s.window.isFullScreen());
    QTest::keyClick(canvas, Qt::Key_Escape);
    QVERIFY(s.window.findChild<RobotSelection*>()->ids().empty());
    QTest::keyClick(&s.window, Qt::Key_F11);
    QVERIFY(s.window.isFullScreen());
    QTest::keyClick(&s.window, Qt::Key_Escape);
    QVERIFY(!s.window.isFullScreen());
    QTRY_VERIFY(s.find<QDockWidget>("robots")->isVisible());
    QVERIFY(s.window.menuBar()->isVisible() && s.window.statusBar()->isVisible());
  }

  void buttonsOfANoticeKeepTheirSize_data() {
    QTest::addColumn<QString>("text");
    QString words, path = QStringLiteral("/home/team/");
    for (int i = 0; i < 30; ++i) {
      words += QStringLiteral("The recording broke off. ");
      path += QStringLiteral("a-long-name-without-a-space_");
    }
    QTest::newRow("short") << QStringLiteral("The recording broke off.");
    QTest::newRow("many words") << words;
    QTest::newRow("one long word") << path + QStringLiteral(" broke off.");
  }
  void buttonsOfANoticeKeepTheirSize() {
    QFETCH(QString, text);
    Studio s({960, 600});
    s.play();
    NoticeBar* bar = s.window.notices();
    bar->show({QStringLiteral("a")}, text,
              {{QStringLiteral("Repair into a new file"), {}}, {QStringLiteral("Not now"), {}}});
    QTRY_COMPARE(bar->findChildren<QPushButton*>().size(), 2);
    const auto* words = bar->findChild<QTextEdit*>(QStringLiteral("noticeText"));
    QTRY_VERIFY(words->height() > 0 && bar->layout()->geometry() == bar->contentsRect());
    for (const auto* button : bar->findChildren<QPushButton*>()) {
      QVERIFY2(button->width() >= button->sizeHint().width(), qPrintable(button->text()));
      QVERIFY2(button->height() >= button->sizeHint().height(), qPrintable(button->text()));
      QVERIFY(bar->rect().contains(button->geometry()));
    }
    QVERIFY(bar->rect().contains(words->geometry()));
    QVERIFY(bar->parentWidget()->rect().contains(bar->geometry()));
    QVERIFY(words->document()->size().height() <= words->height() + 1.0);
    QVERIFY2(words->height() <= 2 * words->fontMetrics().lineSpacing() + 2,
             qPrintable(QString::number(words->height())));
    QCOMPARE(words->toolTip(), words->toPlainText() == text ? QString() : text);
    QVERIFY(words->document()->size().width() <= words->width() + 1.0);
  }

  /// Whatever is brought to the front below or beside it.
  void aNoticeStaysInFront() {
    Studio s({960, 600});
    s.play();
    NoticeBar* bar = s.window.notices();
    bool repaired = false;
    bar->show({QStringLiteral("a")},
              QStringLiteral("The recording of the semifinal was truncated when the power failed "
                             "on the field. What was written can be read and repaired."),
              {{QStringLiteral("Repair"), [&] { repaired = true; }}});
    const auto* button = bar->findChild<QPushButton*>();
    QVERIFY(button);
    const auto inFront = [&] {
      const QPoint at = button->mapTo(&s.window, button->rect().center());
      return s.window.childAt(at) == button;
    };
    QTRY_VERIFY(inFront());
    int tabs = 0;
    for (auto* bars : s.window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
      for (int i = 0; bars->isVisible() && i < bars->count(); ++i, ++tabs) {
        QTest::mouseClick(bars, Qt::LeftButton, {}, bars->tabRect(i).center());
        QCoreApplication::processEvents();
        QVERIFY2(inFront(), qPrintable(bars->tabText(i)));
      }
    }
    QVERIFY(tabs > 1);
    for (auto* panel : s.window.findChildren<QDockWidget*>()) panel->raise();
    s.window.centralWidget()->raise();
    QTRY_VERIFY(inFront());
    QTest::mouseClick(s.window.childAt(button->mapTo(&s.window, button->rect().center())),
                      Qt::LeftButton);
    QVERIFY(repaired);
  }

  void moreNoticesAreShownInTurn() {
    Studio s;
    s.play();
    NoticeBar* bar = s.window.notices();
    for (const char* text : {"one", "two", "three"}) {
      bar->show({QLatin1String(text)}, QLatin1String(text));
    }
    auto* more = bar->findChild<QToolButton*>(QStringLiteral("moreNotices"));
    QCOMPARE(more->text(), QStringLiteral("2 more"));
    for (const char* text : {"two", "one", "three"}) {
      QTest::mouseClick(more, Qt::LeftButton);
      QCOMPARE(bar->text(), QLatin1String(text));
      QCOMPARE(more->text(), QStringLiteral("2 more"));
    }
    bar->settle(QStringLiteral("one"));
    bar->settle(QStringLiteral("two"));
    QVERIFY(!more->isVisible());
  }

  void aRefusalLeavesWithTheNextOrder() {
    Studio s;
    s.play();
    const auto order = [&s](bool good) {
      s.controller.post(MatchOrder{
          QStringLiteral("The goal was not counted"), [good](link::SimulatedMatch&) {
            return good ? Result<void>() : failure(ErrorCode::InvalidArgument, "not in play");
          }});
    };
    const auto notice = [&s] { return s.window.notices()->text(); };
    order(false);
    QTRY_VERIFY2(notice().contains("not in play"), qPrintable(notice()));
    order(true);
    QTRY_VERIFY2(notice().isEmpty(), qPrintable(notice()));
    order(false);
    QTRY_VERIFY(notice().contains("not in play"));
    s.controller.restart();
    QVERIFY2(notice().startsWith(QStringLiteral("Match restarted.")), qPrintable(notice()));
  }

  void noticesNewestFirstAndTheFieldStays() {
    Studio s;
    s.play();
    NoticeBar* bar = s.window.notices();
    const QWidget* field = s.window.centralWidget()->layout()->itemAt(0)->widget();
    const QRect before = field->geometry();
    bar->show({QStringLiteral("a")}, QStringLiteral("old"));
    bar->show({QStringLiteral("b")}, QStringLiteral("new"));
    QCOMPARE(bar->text(), QStringLiteral("new"));
    QVERIFY(bar->isVisible());
    QCOMPARE(field->geometry(), before);
    bar->settle(QStringLiteral("b"));
    QCOMPARE(bar->text(), QStringLiteral("old"));
    bar->settle(QStringLiteral("a"));
    QVERIFY(!bar->isVisible());
    const QString ground = theme().warningGround.name();
    bar->show({QStringLiteral("c"), NoticeTone::Success}, QStringLiteral("saved"));
    QVERIFY(!bar->styleSheet().contains(ground));
    QCOMPARE(bar->grab().toImage().pixelColor(bar->width() / 2, 3), theme().workingGround);
    bar->show({QStringLiteral("d")}, QStringLiteral("bad"));
    QVERIFY(bar->styleSheet().contains(ground));
    QCOMPARE(bar->grab().toImage().pixelColor(bar->width() / 2, 3), theme().warningGround);
    // A scenario that cannot be opened is forgotten when one could.
    s.window.files()->open(s.folder.filePath(QStringLiteral("missing.json")));
    QVERIFY(bar->text().contains(QStringLiteral("missing.json")));
    s.window.files()->open(QStringLiteral("one-robot"));
    QTRY_VERIFY(!bar->text().contains(QStringLiteral("missing.json")));
  }

  void aFinishedMatchOffersTheNextSteps() {
    Studio s;
    link::Scenario scenario = link::loadScenario("one-robot").value();
    scenario.stop.duration = 1.0;
    s.controller.setSpeed(link::MatchRunner::unlimitedSpeed);
    s.controller.open(scenario);
    QTRY_VERIFY(s.window.notices()->text().startsWith(QStringLiteral("The match is over")));
    auto* play = s.find<QAction>("play");
    QTRY_COMPARE(play->text(), QStringLiteral("Play the match again"));
    s.controller.setSpeed(0.01);  // it lasts longer than any slow computer needs to see it
    play->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(s.controller.frame() && !s.controller.frame()->finished, 30'000);
    QVERIFY(s.window.notices()->text().startsWith(QStringLiteral("Match started again.")));
    QTRY_COMPARE(play->text(), QStringLiteral("Pause"));
  }

  // In order of time, wherever the focus is; what cannot be undone now is passed over.
  void undoRevertsTheLastEdit() {
    Studio s;
    s.play();
    auto* plots = s.window.findChild<PlotsDock*>();
    const auto panes = [plots] { return plots->currentPage()->panes().size(); };
    const auto robots = [&s] { return s.controller.frame()->robots.size(); };
    const auto press = [&s](Qt::KeyboardModifiers more = {}) {
      QTest::keyClick(&s.window, Qt::Key_Z, Qt::ControlModifier | more);
    };
    s.window.activateWindow();
    const auto before = panes();
    s.controller.edits()->removeRobots({RobotId{1}});
    QTRY_COMPARE(robots(), std::size_t(5));
    plots->currentPage()->removeAll();
    QTRY_COMPARE(panes(), 0);
    s.window.field()->setFocus();
    press();
    QTRY_COMPARE(panes(), before);
    QCOMPARE(robots(), std::size_t(5));
    QVERIFY2(s.find<QAction>("undo")->text().startsWith(QStringLiteral("Undo Remove")),
             qPrintable(s.find<QAction>("undo")->text()));
    press();
    QTRY_COMPARE(robots(), std::size_t(6));
    QVERIFY(!s.find<QAction>("undo")->isEnabled());
    press(Qt::ShiftModifier);
    QTRY_COMPARE(robots(), std::size_t(5));
    QCOMPARE(panes(), before);
    press(Qt::ShiftModifier);
    QTRY_COMPARE(panes(), 0);
    // The match cannot be changed from the past; the plots can.
    s.controller.edits()->removeRobots({RobotId{2}});
    QTRY_COMPARE(robots(), std::size_t(4));
    s.timeline()->seek(1.0);
    press();
    QTRY_COMPARE(panes(), before);
    QVERIFY(!s.find<QAction>("undo")->isEnabled());
    s.timeline()->goLive();
    press();
    QTRY_COMPARE(robots(), std::size_t(5));
  }

  void whatTheKeyboardReachesHasANameAndAFrame() {
    Studio s;
    s.play();
    s.window.activateWindow();
    QSet<QWidget*> seen;
    QWidget* at = s.find<QComboBox>("speed");
    at->setFocus();
    QTRY_VERIFY(at->hasFocus());
    QRect area;
    QImage focused;
    QString before;
    for (int i = 0; i < 60; ++i) {
      QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
      QWidget* stop = QApplication::focusWidget();
      if (stop == nullptr || seen.contains(stop)) break;
      seen.insert(stop);
      // Where the keys go is seen: the place looks otherwise when they have gone on.
      QVERIFY2(focused.isNull() || s.window.grab(area).toImage() != focused, qPrintable(before));
      area = QRect(stop->mapTo(&s.window, QPoint()), stop->size()).adjusted(-2, -2, 2, 2);
      focused = s.window.grab(area).toImage();
      before = QString::fromLatin1(stop->metaObject()->className()) + ' ' + stop->objectName();
      QAccessibleInterface* sentText = QAccessible::queryAccessibleInterface(stop);
      QVERIFY(sentText);
      const QString name = sentText->text(QAccessible::Name);
      QVERIFY2(!name.isEmpty(), qPrintable(QString::fromLatin1(stop->metaObject()->className()) +
                                           ' ' + stop->objectName()));
    }
    QVERIFY2(seen.size() >= 6, qPrintable(QString::number(seen.size())));
  }

  // B1 keeps the goal there and sees no ball for minutes.
  void theFirstPlotIsNotTheKeepers() {
    Studio s;
    s.controller.open(link::loadScenario("match").value(), true);
    const auto* plots = s.window.findChild<PlotsDock*>();
    const auto inputs = [plots] {
      const auto& curves = plots->currentPage()->panes()[0]->curves();
      return curves.empty() ? QStringList() : curves[0].spec().inputs;
    };
    QTRY_COMPARE(inputs(), QStringList(QStringLiteral("B2/VISION_BALL_DIST")));
    s.controller.edits()->setBehaviour({RobotId{2}}, QStringLiteral("keeper"));
    QTRY_COMPARE(inputs(), QStringList(QStringLiteral("B3/VISION_BALL_DIST")));
  }

  void anAlarmNamesItsEvent() {
    Studio s;
    s.play();
    s.menuAction(QStringLiteral("A goal"))->trigger();
    auto* frame = s.find<QWidget>("alarmFrame");
    link::MatchEvent goal{
        link::MatchEventKind::Goal, 1.0, {}, {}, link::Side::Right, 0, TeamColor::Red};
    emit s.controller.eventsReceived({goal});
    QVERIFY(frame->isVisible());
    QCOMPARE(frame->accessibleName(), QString::fromStdString(sentenceOf(goal)));
    emit s.controller.eventsReceived({goal, goal});
    QVERIFY(frame->accessibleName().endsWith(QStringLiteral("(and 1 more)")));
    // The words stay longer than the edge.
    QTRY_VERIFY(!s.window.findChild<Alarms*>()->isRaised());
    QVERIFY(frame->isVisible());
  }

  void programsInRealTimeAreNotReportedAtSpeed1AndAfterRestart() {
    Studio s;
    s.play();
    const auto notice = [&s] { return s.window.notices()->text(); };
    const auto complain = [&s] {
      emit s.controller.errorOccurred(QStringLiteral("Real time only."), Trouble::Lasting);
    };
    s.controller.setSpeed(2.0);
    complain();
    QCOMPARE(notice(), QStringLiteral("Real time only."));
    s.controller.setPaused(false);
    QCOMPARE(notice(), QStringLiteral("Real time only."));
    s.controller.setSpeed(1.0);
    QVERIFY2(notice().isEmpty(), qPrintable(notice()));
    complain();
    QCOMPARE(notice(), QStringLiteral("Real time only."));
    s.controller.restart();
    QCOMPARE(notice(), QStringLiteral("Match restarted. Ctrl+Z brings the match back."));
  }

  void chosenEventsRaiseAnAlarm() {
    Studio s;
    s.play();
    auto* alarms = s.window.findChild<Alarms*>();
    link::MatchEvent low{link::MatchEventKind::BatteryLow, 1.0, link::uidOf(blue(1)), "B1"};
    emit s.controller.eventsReceived({low});
    QVERIFY(!alarms->isRaised());
    s.menuAction(QStringLiteral("A robot's battery is low"))->trigger();
    emit s.controller.eventsReceived({low});
    QVERIFY(alarms->isRaised());
    QTRY_VERIFY(!alarms->isRaised());
    // A sound only when it is wanted, and once more to hear which.
    int rung = 0;
    alarms->setBell([&rung] { ++rung; });
    emit s.controller.eventsReceived({low});
    QCOMPARE(rung, 0);
    QAction* sound = s.menuAction(QStringLiteral("Play a sound"));
    sound->trigger();
    QCOMPARE(rung, 1);
    link::MatchEvent fall = low;
    fall.kind = link::MatchEventKind::Fall;  // not chosen
    emit s.controller.eventsReceived({fall});
    QCOMPARE(rung, 1);
    emit s.controller.eventsReceived({low});
    QCOMPARE(rung, 2);
    QVERIFY(s.settings.value(QStringLiteral("alarms/sound")).toBool());
    sound->trigger();
    emit s.controller.eventsReceived({low});
    QCOMPARE(rung, 2);
    QCOMPARE(s.settings.value(QStringLiteral("alarms/kinds")).toStringList(),
             QStringList(QStringLiteral("battery-low")));
  }
};

PITCHBOARD_GUI_TEST(TestWindowWork)

}  // namespace tst_window_work

#include "tst_window_work.moc"
