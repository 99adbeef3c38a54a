// SPDX-License-Identifier: GPL-3.0-or-later
// What somebody sees who opens the studio for the first time, and how a match is begun and ended.

#include <QAbstractItemView>
#include <QGraphicsView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QtTest>
#include <cmath>
#include <set>

#include <ui/base/referee_text.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_edits.h>

#include "plot_pane.h"
#include "scenario_chooser.h"
#include "window_rig.h"

namespace tst_first_minute {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

struct Studio : window_rig::Studio {
  using window_rig::Studio::Studio;
  void open(const char* scenario, bool paused = false) {
    controller.open(link::loadScenario(scenario).value(), paused);
    QTRY_VERIFY(controller.frame());
  }
  QLabel* sign(const char* name) { return find<QLabel>(name); }
  bool hasText(const char* name) { return sign(name) != nullptr && sign(name)->isVisible(); }
  QString state() const { return labelText(controller.frame()->game->state); }
};

}  // namespace

class TestFirstMinute : public QObject {
  Q_OBJECT
 private slots:
  void aRobotMovesWithinTwoSeconds() {
    Studio s;
    s.open("kick-off", true);
    const auto begin = s.controller.frame();
    QCOMPARE(begin->robots.size(), std::size_t(8));
    QCOMPARE(s.state(), QStringLiteral("SET"));
    s.controller.runTo(120);
    QTRY_VERIFY(s.controller.frame()->snapshot.tick == 120);
    QCOMPARE(s.state(), QStringLiteral("PLAYING"));
    double farthest = 0.0;
    for (std::size_t i = 0; i < begin->robots.size(); ++i) {
      const Point was = begin->robots[i].pose.position;
      const Point is = s.controller.frame()->robots[i].pose.position;
      farthest = std::max(farthest, std::hypot(is.x - was.x, is.y - was.y));
    }
    QVERIFY2(farthest > 0.05, qPrintable(QString::number(farthest)));
    // Nobody was in the wrong place at the whistle.
    QVERIFY(s.window.findChild<QLabel*>("penaltyStrip")->text().isEmpty());
  }

  // Whatever is opened: within five seconds there is a curve that is not level.
  void theFirstPlotMovesWithinFiveSeconds_data() {
    QTest::addColumn<QString>("scenario");
    for (const char* name : {"kick-off", "match", "match-3v3", "match-11v11", "one-robot",
                             "published-match-3v3", "scenario-1", "scenario-2"}) {
      QTest::newRow(name) << QString::fromUtf8(name);
    }
  }
  void theFirstPlotMovesWithinFiveSeconds() {
    QFETCH(QString, scenario);
    Studio s;
    s.open(qPrintable(scenario), true);
    const double rate = s.controller.frame()->settings->tickRate;
    const auto tick = static_cast<std::uint64_t>(5 * rate);
    s.controller.runTo(tick);
    QTRY_VERIFY(s.controller.frame()->snapshot.tick == tick);
    const auto* plots = s.window.findChild<PlotsDock*>();
    const auto different = [plots] {
      std::set<double> values;
      for (const Curve& curve : plots->currentPage()->panes()[0]->curves()) {
        if (!curve.view()) continue;
        std::vector<telemetry::Sample> samples;
        curve.view().group->samples(curve.view().column, {0.0, 5.0}, samples);
        for (const telemetry::Sample& sample : samples) {
          if (std::isfinite(sample.value)) values.insert(sample.value);
        }
      }
      return values.size();
    };
    QTRY_VERIFY2(different() > 3, qPrintable(QString::number(different())));
  }

  void theLineLeavesAfterTheFirstAction_data() {
    QTest::addColumn<QString>("action");
    for (const char* action : {"drag", "Space", "F1"}) QTest::newRow(action) << QString(action);
  }
  void theLineLeavesAfterTheFirstAction() {
    QFETCH(QString, action);
    Studio s;
    s.open("kick-off", true);
    s.window.activateWindow();
    QTRY_VERIFY(s.hasText("firstSteps") && s.window.isActiveWindow());
    QVERIFY(s.sign("firstSteps")->text().startsWith(QStringLiteral("Drag the ball")));
    auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    QVERIFY(canvas->rect().contains(s.sign("firstSteps")->geometry()));
    if (action == "drag") {
      const QPoint at = canvas->mapFromScene(0, 0);
      QTest::mousePress(canvas->viewport(), Qt::LeftButton, {}, at);
      for (const int by : {10, 30, 60}) {
        const QPointF to = at + QPoint(by, 20);
        QMouseEvent move(QEvent::MouseMove, to, canvas->viewport()->mapToGlobal(to), Qt::NoButton,
                         Qt::LeftButton, {});
        QApplication::sendEvent(canvas->viewport(), &move);
      }
      QTest::mouseRelease(canvas->viewport(), Qt::LeftButton, {}, at + QPoint(60, 20));
      QTRY_VERIFY(s.controller.edits()->undoStack()->count() > 0);
    } else {
      QTest::keyClick(&s.window, action == "F1" ? Qt::Key_F1 : Qt::Key_Space);
    }
    QTRY_VERIFY(!s.hasText("firstSteps"));
    QVERIFY(!s.settings.value(QStringLiteral("window/firstSteps")).toBool());
    MainWindow again(&s.controller, &s.settings);
    QVERIFY(again.findChild<QLabel*>(QStringLiteral("firstSteps")) == nullptr);
  }

  void skipToKickOff() {
    Studio s;
    s.open("match", true);
    QCOMPARE(s.state(), QStringLiteral("INITIAL"));
    auto* button = s.find<QToolButton>("skip");
    QVERIFY(button->isVisible() && button->menu()->actions().size() == 2);
    s.window.activateWindow();
    QTRY_VERIFY(s.window.isActiveWindow());
    QTest::keyClick(&s.window, Qt::Key_J, Qt::ControlModifier | Qt::ShiftModifier);
    QTRY_COMPARE_WITH_TIMEOUT(s.state(), QStringLiteral("PLAYING"), 60'000);
    // It stands where it was looked for, and goes on as before: paused.
    QTRY_VERIFY(s.controller.frame()->paused);
    const std::uint64_t there = s.controller.frame()->snapshot.tick;
    QCOMPARE(s.controller.frame()->game->secondsLeft(), 600);
    s.controller.settle();
    QCOMPARE(s.controller.frame()->snapshot.tick, there);
    QVERIFY(s.controller.isPaused());
    // The next one comes after a goal or at half-time, not here and now.
    s.find<QAction>("skipToKickOff")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(
        s.controller.frame()->snapshot.tick > there + 600 && s.state() == "PLAYING", 60'000);
  }

  void skipToNextEvent() {
    Studio s;
    s.open("kick-off", true);
    const auto marked = [&s] {
      std::vector<double> times;
      for (const link::MatchEvent& event : s.timeline()->events()->events()) {
        if (s.timeline()->filter().shows(event)) times.push_back(event.time);
      }
      return times;
    };
    s.window.activateWindow();
    QTRY_VERIFY(s.window.isActiveWindow());
    for (int i = 0; i < 3; ++i) {
      const double before = s.controller.frame()->snapshot.time;
      QTest::keyClick(&s.window, Qt::Key_J, Qt::ControlModifier);
      QTRY_VERIFY_WITH_TIMEOUT(
          s.controller.frame()->snapshot.time > before && s.controller.frame()->paused, 60'000);
      s.controller.settle();
      QVERIFY(!marked().empty());
      // An event has the time at which its tick began.
      const double since = s.controller.frame()->snapshot.time - marked().back();
      QVERIFY2(since >= 0.0 && since < 1.5 / 60, qPrintable(QString::number(since)));
    }
    // Not while the past is shown.
    s.timeline()->seek(0.2);
    QVERIFY(!s.find<QAction>("skipToEvent")->isEnabled());
    s.timeline()->goLive();
    // A match without a referee says why.
    s.open("match-3v3", true);
    QTRY_COMPARE(s.controller.frame()->robots.size(), std::size_t(6));
    const auto* kickOff = s.find<QAction>("skipToKickOff");
    QTRY_VERIFY(!kickOff->isEnabled() && s.find<QAction>("skipToEvent")->isEnabled());
    QVERIFY2(kickOff->toolTip().contains(QStringLiteral("no referee")),
             qPrintable(kickOff->toolTip()));
    s.open("match", true);
    QTRY_VERIFY(kickOff->isEnabled());
    QVERIFY2(kickOff->toolTip().startsWith(QStringLiteral("Plays at full speed")),
             qPrintable(kickOff->toolTip()));
  }

  void theFirstFrameIsTheField() {
    struct Watch : QObject {
      QStringList texts;
      bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() == QEvent::Paint && controller->frame() == nullptr)
          texts << controller->emptyText();
        return false;
      }
      MatchController* controller = nullptr;
    } watch;
    Studio s;
    watch.controller = &s.controller;
    auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    canvas->viewport()->installEventFilter(&watch);
    const link::Scenario large = link::loadScenario("match-11v11").value();
    s.controller.open(large);
    // The field of this match, before its first frame is there.
    QVERIFY(!s.controller.frame());
    const QPoint goal = canvas->mapFromScene(large.settings.field.halfLength(), 0);
    QVERIFY(canvas->viewport()->rect().contains(goal));
    s.window.repaint();
    QTRY_VERIFY(s.controller.frame());
    canvas->viewport()->removeEventFilter(&watch);
    for (const QString& text : std::as_const(watch.texts)) {
      QVERIFY2(!text.contains(QStringLiteral("No match is open")), qPrintable(text));
    }
  }

  void aMatchThatCannotBeOpenedReportsWhy() {
    Studio s;
    link::Scenario scenario = link::loadScenario("one-robot").value();
    scenario.settings.physics = "no-such-model";
    s.controller.open(scenario);
    QTRY_VERIFY(!s.controller.whyNotOpened().isEmpty());
    QVERIFY(s.controller.emptyText().startsWith(QStringLiteral("The match could not be opened.")));
    NoticeBar* bar = s.window.notices();
    QVERIFY2(bar->text().contains(s.controller.whyNotOpened()), qPrintable(bar->text()));
    const auto press = [bar](const QString& text) {
      for (QPushButton* button : bar->findChildren<QPushButton*>()) {
        if (button->text() == text && button->isVisible())
          return QTest::mouseClick(button, Qt::LeftButton);
      }
      QFAIL(qPrintable(text));
    };
    press(QStringLiteral("Try again"));
    QVERIFY(s.controller.isOpening());
    QTRY_VERIFY(!s.controller.whyNotOpened().isEmpty());
    press(QStringLiteral("Choose a scenario"));
    auto* chooser = s.window.findChild<ScenarioChooser*>();
    QTRY_VERIFY(chooser->view()->isVisible());
    chooser->hidePopup();
    s.window.files()->open(QStringLiteral("one-robot"));
    QTRY_VERIFY(s.controller.frame() && s.controller.whyNotOpened().isEmpty());
    QVERIFY(!bar->text().contains(QStringLiteral("could not be opened")));
  }

  void afterTheWhistleTheFieldShowsTheNextSteps() {
    Studio s;
    link::Scenario scenario = link::loadScenario("one-robot").value();
    scenario.stop.duration = 1.0;
    s.controller.setSpeed(link::MatchRunner::unlimitedSpeed);
    s.controller.open(scenario);
    QTRY_VERIFY(s.hasText("finalWhistle"));
    QVERIFY(s.sign("finalWhistle")->text().contains(QStringLiteral("Space plays again")));
    s.timeline()->seek(0.5);
    QTRY_VERIFY(!s.hasText("finalWhistle"));
    s.timeline()->goLive();
    QTRY_VERIFY(s.hasText("finalWhistle"));
    s.controller.setSpeed(0.01);
    QTest::keyClick(&s.window, Qt::Key_Space);
    QTRY_VERIFY(!s.hasText("finalWhistle"));
  }
};

PITCHBOARD_GUI_TEST(TestFirstMinute)

}  // namespace tst_first_minute

#include "tst_first_minute.moc"
