// SPDX-License-Identifier: GPL-3.0-or-later
// A match that goes on from an earlier moment leaves a future behind: a dashed branch.

#include <QGraphicsView>
#include <QMenu>
#include <QPushButton>
#include <QtTest>

#include <ui/field/field_view.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/event_list.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>

#include "chart_pane.h"
#include "compared_item.h"
#include "plot_feed.h"
#include "timeline_strip.h"
#include "window_rig.h"

namespace tst_branch {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

struct Studio : window_rig::Studio {
  using window_rig::Studio::Studio;
  AbandonedFuture* future() { return window.future(); }
  void playTo(std::uint64_t tick) {
    controller.runTo(tick);
    QTRY_VERIFY(controller.frame() && controller.frame()->snapshot.tick == tick);
    controller.settle();
  }
  /// Ten seconds, and back to this moment.
  void leaveAt(double time) {
    timeline()->seek(time);
    QVERIFY(timeline()->isLookingBack());
    menuAction(QStringLiteral("Continue the match"))->trigger();
    QTRY_COMPARE(controller.frame()->snapshot.time, time);
    QTRY_COMPARE(controller.series()->range()->end, time);
  }
  int ghosts() {
    for (QGraphicsItem* item : window.field()->findChild<QGraphicsView*>()->scene()->items()) {
      if (const auto* compared = dynamic_cast<ComparedItem*>(item)) return compared->robots();
    }
    return 0;
  }
  QAction* action(const char* name) { return find<QAction>(name); }
};

}  // namespace

class TestBranch : public QObject {
  Q_OBJECT
 private slots:
  void theAbandonedFutureIsPale() {
    Studio s;
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.playTo(1800);
    QVERIFY(!s.future()->isOn() && !s.action("dropFuture")->isVisible());
    auto* strip = s.find<TimelineStrip>("timelineStrip");
    QVERIFY(strip->branchRect().isEmpty());
    const int low = strip->height();
    QVERIFY(s.timeline()->events()->events().back().time > 4.0);
    s.leaveAt(4.0);
    QTRY_VERIFY(s.future()->isOn());
    QCOMPARE(s.future()->begin(), 4.0);
    QCOMPARE(s.future()->end(), 30.0);
    // Events and rows belong to one of both.
    QVERIFY(s.timeline()->events()->events().empty() ||
            s.timeline()->events()->events().back().time <= 4.0);
    QVERIFY(!s.future()->events().events().empty());
    QVERIFY(s.future()->events().events().front().time > 4.0);
    QCOMPARE(s.future()->series()->range()->end, 30.0);
    QCOMPARE(s.controller.series()->range()->end, 4.0);
    // The strip makes room for it, and shows all of it.
    QTRY_VERIFY(strip->height() > low);
    QTRY_VERIFY(strip->axis().shown.end >= 30.0);
    const QRect row = strip->branchRect();
    QVERIFY(row.width() > 20 && row.bottom() < strip->bandRect().top());
    const QImage picture = strip->grab().toImage();
    const double scale = picture.devicePixelRatio();
    const auto colourAt = [&](QPoint at) {
      return picture.pixelColor((QPointF(at) * scale).toPoint());
    };
    QVERIFY(colourAt(row.center() + QPoint(3, 0)) != theme().window);
    QCOMPARE(colourAt(QPoint(row.left() - 8, row.center().y())), theme().window);
    QVERIFY(s.window.notices()->text().contains(QStringLiteral("Continuing the match from 00:04")));
    QVERIFY(s.window.notices()->text().contains(QStringLiteral("dashed branch")));
  }

  void itIsComparedAndDropped() {
    Studio s({1280, 800});
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.playTo(600);
    s.leaveAt(4.0);
    // It goes another way now.
    s.controller.edits()->moveBall({2.0, 2.0});
    s.playTo(480);
    auto* plots = s.window.findChild<PlotsDock*>();
    plots->plotVariables({QStringLiteral("match/BALL_X")});
    const auto& compared = plots->feed()->compared();
    QTRY_COMPARE(compared.size(), 1U);
    QCOMPARE(compared[0].caption, QStringLiteral("abandoned at 00:04"));
    QVERIFY(plots->feed()->find(compared[0], QStringLiteral("match/BALL_X")));
    QCOMPARE(s.ghosts(), 0);
    s.action("compareFuture")->trigger();
    QTRY_COMPARE(s.ghosts(), 8);
    s.timeline()->seek(3.0);
    QTRY_COMPARE(s.ghosts(), 0);
    s.timeline()->seek(6.0);
    QTRY_COMPARE(s.ghosts(), 8);
    s.timeline()->goLive();
    // Live has no branch, and it is still there afterwards.
    s.window.showSource(SourceKind::Live);
    QVERIFY(!s.future()->isOn() && plots->feed()->compared().empty());
    s.window.showSource(SourceKind::Simulate);
    QVERIFY(s.future()->isOn());
    s.action("dropFuture")->trigger();
    QVERIFY(!s.future()->isOn() && s.future()->series() == nullptr);
    QTRY_COMPARE(s.ghosts(), 0);
    QVERIFY(plots->feed()->compared().empty());
    QVERIFY(!s.action("dropFuture")->isVisible());
    QVERIFY(s.find<TimelineStrip>("timelineStrip")->branchRect().isEmpty());
  }

  void itsCurvesAreDashedAndNamed() {
    Studio s({1280, 800});
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.playTo(600);
    auto* plots = s.window.findChild<PlotsDock*>();
    PaneSpec one;
    one.curves << variableCurve("match/SCORE_LEFT");
    plots->setLayoutSpec({{PageSpec{"one", {one}}}, 0});
    s.leaveAt(4.0);
    plots->time()->setRange({0.0, 10.0});
    auto* pane = plots->findChild<ChartPane*>();
    QTRY_COMPARE(pane->captions(), QStringList(QStringLiteral("dashed: abandoned at 00:04")));
    // Strokes of the curve's hue along the line that says 0, which both futures have.
    const auto strokes = [pane](double from, double until) {
      const QImage picture = pane->surface()->grab().toImage();
      const auto x = [&](double time) {
        return qRound(pane->timeAxis().pixel(time) * picture.devicePixelRatio());
      };
      int most = 0;
      for (int y = 0; y < picture.height(); ++y) {
        int runs = 0;
        bool before = false;
        for (int at = x(from); at < x(until); ++at) {
          const QColor color = picture.pixelColor(at, y);
          const bool inked = color.blue() - color.red() > 25;
          if (inked && !before) ++runs;
          before = inked;
        }
        most = std::max(most, runs);
      }
      return most;
    };
    QTRY_VERIFY(strokes(4.5, 9.5) > 10);
    // Only where a dashed curve is: neither before the moment nor behind its end.
    plots->time()->setRange({0.0, 3.0});
    QTRY_VERIFY(pane->captions().isEmpty());
    plots->time()->setRange({12.0, 20.0});
    QVERIFY(pane->captions().isEmpty());
    plots->time()->setRange({3.0, 6.0});
    QTRY_COMPARE(pane->captions().size(), 1);
    // The strip writes it, too.
    const auto* strip = s.find<TimelineStrip>("timelineStrip");
    QVERIFY(strip->branchRect().height() >= strip->fontMetrics().ascent());
  }

  void theSecondOneReplacesTheFirst() {
    Studio s;
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.playTo(600);
    s.leaveAt(5.0);
    QTRY_COMPARE(s.future()->end(), 10.0);
    s.playTo(420);
    s.leaveAt(3.0);
    QTRY_COMPARE(s.future()->begin(), 3.0);
    QCOMPARE(s.future()->end(), 7.0);
    s.find<QAction>("restart")->trigger();
    QTRY_VERIFY(s.controller.isOpen());
    QVERIFY(!s.future()->isOn());
  }

  void memoryIsGivenBack() {
    Studio s;
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.playTo(600);
    std::weak_ptr<const telemetry::SeriesStore> rows;
    s.leaveAt(2.0);
    QTRY_VERIFY(s.future()->isOn());
    rows = s.future()->series();
    s.controller.memory()->setMemoryBudget(1 << 16);
    s.playTo(240);
    QTRY_VERIFY(!s.future()->isOn());
    QVERIFY(rows.expired() || rows.use_count() <= 1);
  }
};

PITCHBOARD_GUI_TEST(TestBranch)

}  // namespace tst_branch

#include "tst_branch.moc"
