// SPDX-License-Identifier: GPL-3.0-or-later
// The legend: one row that scrolls, clicks that hide, what it says of the axes.
#include <QUndoStack>
#include <QtTest>

#include <ui/base/theme.h>

#include "../support/mouse_wheel.h"
#include "chart_pane.h"
#include "plot_rig.h"

namespace tst_plot_legend {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;

class TestPlotLegend : public QObject {
  Q_OBJECT

  /// A chart of B1's DIST plus 0, 1, 2, ...
  static ChartPane* chartOf(Bench& bench, int curves) {
    PaneSpec spec;
    for (int i = 0; i < curves; ++i) {
      spec.curves << expression(QStringLiteral("B1.DIST + %1").arg(100 * i));
      spec.curves.back().colorNumber = i;
    }
    bench.time.setRange({0.0, 10.0});
    return qobject_cast<ChartPane*>(bench.dock->currentPage()->insertPane(0, spec));
  }
  static void click(LegendBar* legend, int index) {
    QTest::mouseClick(legend, Qt::LeftButton, {}, legend->rectOf(index).center());
  }
  static QList<bool> hidden(const PlotPane* pane) {
    QList<bool> all;
    for (const Curve& curve : pane->curves()) all << curve.isHidden();
    return all;
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void oneRowScrolls() {
    Bench b;
    ChartPane* chart = chartOf(b, 12);
    LegendBar* legend = chart->legend();
    QCoreApplication::processEvents();
    const int height = legend->height();
    QVERIFY2(height <= scaled(legend, 16), qPrintable(QString::number(height)));
    QVERIFY(!legend->rectOf(0).isEmpty() && legend->rectOf(11).isEmpty());
    // By the arrow at the right end, one entry each.
    const QPoint on(legend->width() - chart->right() - 4, height / 2);
    QTest::mouseClick(legend, Qt::LeftButton, {}, on);
    QCOMPARE(legend->first(), 1);
    QVERIFY(legend->rectOf(0).isEmpty());
    QCOMPARE(hidden(chart).count(true), 0);  // an arrow is no entry
    // By the wheel to the last one, and no further.
    for (int i = 0; i < 30; ++i) wheel(legend, {100, height / 2}, -1);
    QVERIFY(!legend->rectOf(11).isEmpty());
    const int last = legend->first();
    wheel(legend, {100, height / 2}, -1);
    QCOMPARE(legend->first(), last);
    wheel(legend, {100, height / 2}, 1);
    QCOMPARE(legend->first(), last - 1);
    for (int i = 0; i < 30; ++i) wheel(legend, {100, height / 2}, 1);
    QCOMPARE(legend->first(), 0);
    QCOMPARE(legend->height(), height);
    // Where all fit there is nothing to scroll.
    ChartPane* few = chartOf(b, 2);
    QCoreApplication::processEvents();
    wheel(few->legend(), {100, height / 2}, -1);
    QCOMPARE(few->legend()->first(), 0);
  }

  void aClickHides() {
    Bench b;
    ChartPane* chart = chartOf(b, 3);
    QTRY_VERIFY(chart->valueScale().limits.high > 300.0);
    click(chart->legend(), 2);
    QCOMPARE(hidden(chart), QList<bool>({false, false, true}));
    QVERIFY(chart->legend()->entries()[2].hidden);
    // Not drawn, and without a share in the limits.
    QTRY_VERIFY(chart->valueScale().limits.high < 300.0);
    QVERIFY(!chart->traces()[2].any);
    click(chart->legend(), 2);
    QCOMPARE(hidden(chart).count(true), 0);
    QTRY_VERIFY(chart->valueScale().limits.high > 300.0);
  }

  void aDoubleClickLeavesOne() {
    Bench b;
    ChartPane* chart = chartOf(b, 3);
    QCoreApplication::processEvents();
    const auto twice = [&](int index) {
      const QPoint at = chart->legend()->rectOf(index).center();
      QTest::mouseClick(chart->legend(), Qt::LeftButton, {}, at);
      QTest::mouseDClick(chart->legend(), Qt::LeftButton, {}, at);
    };
    twice(1);
    QCOMPARE(hidden(chart), QList<bool>({true, false, true}));
    twice(2);
    QCOMPARE(hidden(chart), QList<bool>({true, true, false}));
    twice(2);
    QCOMPARE(hidden(chart).count(true), 0);
  }

  void oneOfEveryRobotIsHidden() {
    Bench b;
    PlotPane* pane = b.show(variableCurve(QStringLiteral("each/DIST")));
    QCoreApplication::processEvents();
    click(pane->legend(), 1);
    QCOMPARE(hidden(pane), QList<bool>({false, true}));
    QCOMPARE(pane->spec().curves.size(), 1);
  }

  void itIsUndoneAndKept() {
    Bench b;
    ChartPane* chart = chartOf(b, 3);
    QCoreApplication::processEvents();
    click(chart->legend(), 1);
    const auto layout = b.dock->layoutSpec();
    b.dock->undoStack()->undo();
    QCOMPARE(hidden(b.dock->currentPage()->panes()[0]).count(true), 0);
    b.dock->undoStack()->redo();
    QCOMPARE(hidden(b.dock->currentPage()->panes()[0]), QList<bool>({false, true, false}));
    QCOMPARE(b.dock->layoutSpec().pages[0].panes[0].curves, layout.pages[0].panes[0].curves);
  }
};

PITCHBOARD_GUI_TEST(TestPlotLegend)

}  // namespace tst_plot_legend

#include "tst_plot_legend.moc"
