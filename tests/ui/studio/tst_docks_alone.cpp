// SPDX-License-Identifier: GPL-3.0-or-later
// Every panel works when another one is not there: each is taken away in turn and the rest is used.
#include <QDockWidget>
#include <QTableView>
#include <QTest>
#include <QToolButton>

#include <ui/sources/linked_time.h>
#include <ui/sources/match_memory.h>

#include "chart_pane.h"
#include "dock_list.h"
#include "timeline_strip.h"
#include "variables_model.h"
#include "window_rig.h"

namespace tst_docks_alone {

using namespace window_rig;

class TestDocksAlone : public QObject {
  Q_OBJECT
 private slots:
  void theRestWorks_data() {
    QTest::addColumn<QString>("gone");
    for (const DockInfo& info : studioDocks()) {
      QTest::newRow(info.id) << QString::fromUtf8(info.id);
    }
  }
  void theRestWorks() {
    QFETCH(QString, gone);
    Studio s;
    s.play();
    QDockWidget* dock = s.find<QDockWidget>(qPrintable(gone));
    QVERIFY(dock);
    delete dock->widget();
    ShownMoment& shown = *s.timeline();
    LinkedTime& time = *s.window.findChild<LinkedTime*>();
    auto* strip = s.window.findChild<TimelineStrip*>();
    auto* plots = s.window.findChild<PlotsDock*>();
    auto* variables = s.window.findChild<VariablesModel*>();
    QCOMPARE(strip == nullptr, gone == QStringLiteral("timeline"));
    QCOMPARE(plots == nullptr, gone == QStringLiteral("plots"));
    const auto tick = [variables] {
      variables->refreshAll();
      const QModelIndex row = variables->find(QStringLiteral("match/TICK"));
      return row.siblingAtColumn(VariablesModel::Value).data().toString();
    };

    // The axis that plots and timeline share follows the match and the moment.
    QTRY_COMPARE(time.playhead(), std::optional(5.0));
    time.setWindow(1.0);
    QCOMPARE(time.range().end, 5.0);
    shown.seek(2.0);
    QVERIFY(shown.isLookingBack());
    QCOMPARE(time.playhead(), std::optional(2.0));
    QVERIFY(time.range().begin <= 2.0 && time.range().end >= 2.0);
    if (variables != nullptr) QTRY_COMPARE(tick(), QStringLiteral("120.00"));
    QVERIFY(s.find<QToolButton>("now") == nullptr || s.find<QToolButton>("now")->isChecked());

    // A click in one of them goes there for all.
    if (strip != nullptr) {
      QVERIFY(strip->rangeHandle());
      const int x = qRound(strip->axis().pixel(3.0));
      QTest::mouseClick(strip, Qt::LeftButton, {}, {x, strip->height() / 2});
      QVERIFY(std::abs(shown.time() - 3.0) < 2 * strip->axis().secondsPerPixel());
      QCOMPARE(time.playhead(), std::optional(shown.time()));
    }
    if (plots != nullptr) {
      time.setRange({0.0, 5.0});
      plots->plotVariables({QStringLiteral("B1/VISION_BALL_DIST")});
      const auto* chart = plots->findChild<ChartPane*>();
      QVERIFY(chart);
      QTRY_VERIFY(chart->timeAxis().width > 100);
      const QPoint at(qRound(chart->timeAxis().pixel(4.0)), chart->surface()->height() / 2);
      QTest::mouseClick(chart->surface(), Qt::LeftButton, {}, at);
      QVERIFY(std::abs(shown.time() - 4.0) < 2 * chart->timeAxis().secondsPerPixel());
    }
    if (variables != nullptr) {
      const int there = static_cast<int>(std::floor(shown.time() * 60.0 + 1e-6));
      QTRY_COMPARE(tick(), QStringLiteral("%1.00").arg(there));
    }

    // The match goes on from there; another source, and back.
    shown.seek(1.0);
    s.controller.memory()->continueFrom(1.0);
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(60));
    QTRY_VERIFY(!shown.isLookingBack());
    QTRY_COMPARE(time.playhead(), std::optional(1.0));
    s.window.showSource(SourceKind::Replay);
    QVERIFY(!shown.frame());
    s.window.showSource(SourceKind::Simulate);
    QCOMPARE(shown.frame()->snapshot.tick, std::uint64_t(60));
  }
};

PITCHBOARD_GUI_TEST(TestDocksAlone)

}  // namespace tst_docks_alone

#include "tst_docks_alone.moc"
