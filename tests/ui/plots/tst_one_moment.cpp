// SPDX-License-Identifier: GPL-3.0-or-later
// Plots and timeline speak of the same moment: real clicks on plots of a source that goes on.
#include <QMenu>
#include <QtTest>

#include <ui/base/theme.h>
#include <ui/sources/shown_moment.h>
#include <ui/timeline/timeline_actions.h>

#include "../support/menu_entry.h"
#include "../support/robot_keys.h"
#include "chart_pane.h"
#include "legend_bar.h"
#include "plot_page.h"
#include "plot_source.h"
#include "time_ruler.h"

namespace tst_one_moment {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

class MomentSource : public PlotSource {
 public:
  void happen(double time, link::MatchEventKind kind, const char* robot) {
    const int number = QString::fromLatin1(robot).mid(1).toInt();
    emit eventsReceived(
        {{kind, time, link::uidOf(*robot == 'R' ? red(number) : blue(number)), robot}});
  }
};

/// 30 s of B1, as a chart that follows with a window of 15 s.
struct Bench {
  MomentSource source;
  ShownMoment timeline{&source};
  LinkedTime time{&timeline};
  TimelineActions actions{&timeline, &time, nullptr, nullptr};
  telemetry::GroupId group = source.fill("B1", 30.0);
  std::unique_ptr<PlotsDock> dock;
  ChartPane* chart = nullptr;

  Bench() {
    PlotsContext context;
    context.shown = &timeline;
    context.time = &time;
    dock = std::make_unique<PlotsDock>(context, nullptr);
    dock->resize(1000, 300);
    dock->show();
    source.goTo(30.0);
    dock->plotVariables({QStringLiteral("B1/DIST")});
    chart = qobject_cast<ChartPane*>(dock->currentPage()->panes().value(0));
    QVERIFY(chart);
    QTRY_VERIFY(chart->timeAxis().width > 500);
    QCOMPARE(time.range().end, 30.0);
  }
  QPoint at(double moment) const { return {qRound(chart->timeAxis().pixel(moment)), 60}; }
  void point(QPoint to) const {
    QMouseEvent move(QEvent::MouseMove, to, chart->surface()->mapToGlobal(to), Qt::NoButton,
                     Qt::NoButton, {});
    QApplication::sendEvent(chart->surface(), &move);
  }
  QString legend() const { return chart->legend()->entries()[0].value; }
};

constexpr double onePixel = 0.03;  // s, at this size

}  // namespace

class TestOneMoment : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aClickInAPlotGoesThere() {
    Bench b;
    const telemetry::TimeRange before = b.time.range();
    QTest::mouseClick(b.chart->surface(), Qt::LeftButton, {}, b.at(20.0));
    QVERIFY(b.timeline.isLookingBack());
    QVERIFY(std::abs(b.timeline.time() - 20.0) < onePixel);
    QCOMPARE(b.time.playhead(), std::optional(b.timeline.time()));
    // What was clicked at stays where it is, and a click is no drag.
    QCOMPARE(b.time.range(), before);
    QVERIFY(b.time.isFollowing());
    const double tick = std::floor(b.timeline.time() * 60.0 + 1e-9) / 60.0;
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(b.chart->surface(), &leave);
    QCOMPARE(b.legend(), valueText(PlotSource::distanceAt(tick)));
    b.timeline.goLive();
    QCOMPARE(b.time.playhead(), std::optional(30.0));
    QCOMPARE(b.legend(), valueText(PlotSource::distanceAt(30.0)));
  }

  void theMomentIsALineInEveryPlot() {
    Bench b;
    b.dock->plotVariables({QStringLiteral("B1/ACTION")});
    b.timeline.seek(22.0);
    QTRY_COMPARE(b.dock->currentPage()->panes().size(), 2);
    const auto isThere = [&b](const PlotPane* pane, int y) {
      const QImage image = b.dock->grab().toImage();
      const QPoint at(qRound(pane->timeAxis().pixel(22.0)), y);
      const QPoint in = pane->surface()->mapTo(b.dock.get(), at);
      const QColor line = theme().accentLine;
      for (int x = in.x() - 2; x <= in.x() + 2; ++x) {
        const QColor is = image.pixelColor(QPoint(x, in.y()) * image.devicePixelRatio());
        if (std::abs(is.red() - line.red()) + std::abs(is.green() - line.green()) +
                std::abs(is.blue() - line.blue()) <
            30)
          return true;
      }
      return false;
    };
    for (const PlotPane* pane : b.dock->currentPage()->panes()) {
      QTRY_VERIFY(isThere(pane, pane->surface()->height() / 2));
    }
    // The name of a lane is not struck through.
    QVERIFY(!isThere(b.dock->currentPage()->panes()[1], 4));
  }

  void aDoubleClickTakesItsClickBack() {
    Bench b;
    QTest::mouseClick(b.chart->surface(), Qt::LeftButton, {}, b.at(20.0));
    QTest::mouseClick(b.chart->surface(), Qt::LeftButton, {}, b.at(25.0));
    QTest::mouseDClick(b.chart->surface(), Qt::LeftButton, {}, b.at(25.0));
    QVERIFY(std::abs(b.timeline.time() - 20.0) < onePixel);
    QCOMPARE(b.time.range(), (telemetry::TimeRange{0.0, 30.0}));
    b.timeline.goLive();
    QTest::mouseClick(b.chart->surface(), Qt::LeftButton, {}, b.at(10.0));
    QVERIFY(b.timeline.isLookingBack());
    QTest::mouseDClick(b.chart->surface(), Qt::LeftButton, {}, b.at(10.0));
    QVERIFY(!b.timeline.isLookingBack());
  }

  void plotsScrollWithThePast() {
    Bench b;
    b.timeline.seek(16.0);
    QCOMPARE(b.time.range().begin, 14.5);  // a tenth of 15 s stays free at the edge
    b.timeline.seek(5.0);
    QCOMPARE(b.time.range().begin, 3.5);
    b.timeline.setPaused(false);
    b.timeline.advance(12.5);
    QCOMPARE(b.timeline.time(), 17.5);
    QCOMPARE(b.time.range().end, 19.0);
    b.timeline.setPaused(true);
    // A range that the user has chosen stays.
    b.time.setRange({0.0, 4.0});
    b.timeline.seek(18.0);
    QCOMPARE(b.time.range(), (telemetry::TimeRange{0.0, 4.0}));
    b.timeline.seek(2.0);
    b.timeline.seek(9.0);  // it was in sight and goes out of it
    QVERIFY(b.time.range().begin <= 9.0 && b.time.range().end >= 9.0);
    b.timeline.goLive();
    b.time.setFollowing(true);
    QCOMPARE(b.time.range().end, 30.0);
  }

  void theCrosshairStaysUnderAStillPointer() {
    Bench b;
    const QPoint at = b.at(24.0);
    b.point(at);
    const double before = *b.time.cursor();
    for (int i = 1; i <= 180; ++i) b.source.append(b.group, 30.0 + i / 60.0, 0, 100.0);
    b.dock->feed()->refresh();
    QCOMPARE(b.time.range().end, 33.0);
    QVERIFY(std::abs(*b.time.cursor() - before - 3.0) < 1e-9);
    QCOMPARE(qRound(b.chart->timeAxis().pixel(*b.time.cursor())), at.x());
    // The value at the pointer's height, as the axis has it.
    const auto* lines = b.dock->findChild<TimeLines*>();
    QVERIFY(lines->pointed());
    QCOMPARE(lines->pointed()->text, valueText(b.chart->valueScale().toValue(at.y())));
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(b.chart->surface(), &leave);
    QVERIFY(!b.time.cursor());
    QVERIFY(!lines->pointed());
  }

  void goingBackStepsPastTheEventWhilePlaying() {
    Bench b;
    b.source.happen(10.0, link::MatchEventKind::Goal, "");
    b.source.happen(20.0, link::MatchEventKind::Fall, "B1");
    b.timeline.seek(25.0);
    b.timeline.setPaused(false);
    b.actions.previous()->trigger();
    QCOMPARE(b.timeline.time(), 20.0);
    b.timeline.advance(0.4);
    b.actions.previous()->trigger();
    QCOMPARE(b.timeline.time(), 10.0);
    // Later it is the event just left that is meant.
    b.actions.next()->trigger();
    QCOMPARE(b.timeline.time(), 20.0);
    b.timeline.advance(4.0);
    b.actions.previous()->trigger();
    QCOMPARE(b.timeline.time(), 20.0);
  }

  void eventsAreFilteredByKindAndRobot() {
    Bench b;
    b.source.happen(5.0, link::MatchEventKind::Kick, "B1");
    b.source.happen(10.0, link::MatchEventKind::Fall, "B1");
    b.source.happen(15.0, link::MatchEventKind::Fall, "R2");
    b.source.happen(20.0, link::MatchEventKind::Kick, "R2");
    QMenu menu;
    b.actions.fill(&menu);
    auto* shown = menu.findChild<QMenu*>(QStringLiteral("eventsShown"));
    const auto entry = [shown](const QString& text) {
      emit shown->aboutToShow();
      return menu_entry::beginning(shown->actions(), text);
    };
    QVERIFY(entry(QStringLiteral("Kicks the ball (2)")));
    entry(QStringLiteral("Kicks the ball"))->trigger();
    b.actions.previous()->trigger();
    QCOMPARE(b.timeline.time(), 15.0);
    entry(QStringLiteral("Only B1"))->trigger();
    b.actions.previous()->trigger();
    QCOMPARE(b.timeline.time(), 10.0);
    QVERIFY(!b.timeline.goToNextEvent());
    entry(QStringLiteral("All"))->trigger();
    b.actions.next()->trigger();
    QCOMPARE(b.timeline.time(), 15.0);
    QVERIFY(!entry(QStringLiteral("All"))->isEnabled());
  }

  void robotsOfTheFilterAreInOrder() {
    Bench b;
    for (const char* robot : {"R2", "B10", "B2"}) {
      b.source.happen(5.0, link::MatchEventKind::Kick, robot);
    }
    QMenu menu;
    b.actions.fill(&menu);
    auto* shown = menu.findChild<QMenu*>(QStringLiteral("eventsShown"));
    emit shown->aboutToShow();
    QStringList robots;
    for (const QAction* action : shown->actions()) {
      if (action->text().startsWith(QStringLiteral("Only "))) robots << action->text().mid(5);
    }
    QCOMPARE(robots, (QStringList{"B2", "B10", "R2"}));
  }
};

PITCHBOARD_GUI_TEST(TestOneMoment)

}  // namespace tst_one_moment

#include "tst_one_moment.moc"
