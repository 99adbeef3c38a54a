// SPDX-License-Identifier: GPL-3.0-or-later
// One variable over another.

#include <QMenu>
#include <QtTest>

#include <simcore/world/action_codes.h>
#include <ui/base/theme.h>
#include <ui/plots/plots_dock.h>

#include "../support/menu_entry.h"
#include "chart_pane.h"
#include "lane_pane.h"
#include "plot_page.h"
#include "plot_rig.h"
#include "plot_source.h"
#include "time_ruler.h"
#include "value_chart.h"
#include "xy_pane.h"

namespace tst_xy_plots {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;

class TestXyPlots : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void oneVariableOverAnother() {
    Shown s;
    QCoreApplication::processEvents();
    dropOn(s.page(), {"B1/DIST", "B1/ANGLE"}, QPoint(s.page()->width() - 20, 200));
    auto* xy = qobject_cast<XyPane*>(s.pane());
    QVERIFY(xy);
    s.time.setRange({0.0, 2.0});
    QTRY_COMPARE(xy->points().at(0).size(), std::size_t(121));
    for (int i = 0; i <= 120; ++i) {
      QCOMPARE(xy->points()[0][std::size_t(i)],
               QPointF(PlotSource::distanceAt(i / 60.0), 90.0 * (i / 60.0)));
    }
    QVERIFY(xy->xLimits().low <= 100.0 && xy->xLimits().high >= 145.0);
    const double before = xy->xLimits().high - xy->xLimits().low;
    wheel(xy->surface(), xy->surface()->rect().center(), 2);
    QVERIFY(xy->xLimits().high - xy->xLimits().low < before);
    QTest::mouseDClick(xy->surface(), Qt::LeftButton, {}, {300, 60});
    QCOMPARE(xy->xLimits().high - xy->xLimits().low, before);
  }

  void linesOfAnXyPlotAreBrokenWhereAValueIsMissing() {
    const double none = std::nan("");
    const auto stretches = stretchesOf({{0, none}, {1, 1}, {2, 4}, {none, 0}, {4, 16}}, 2);
    QVERIFY(stretches.has_value());
    QCOMPARE(stretches->size(), std::size_t(2));
    QCOMPARE(stretches->at(0), (QList<QPointF>{{1, 1}, {2, 4}}));
    QCOMPARE(stretches->at(1), (QList<QPointF>{{4, 16}}));
    QVERIFY(!stretchesOf({{0, 0}, {1, none}, {2, 0}, {3, none}, {4, 0}}, 2));
  }

  void theCurvesOfAnXyPlotAreSeen_data() {
    QTest::addColumn<CurveStyle>("style");
    QTest::newRow("line") << CurveStyle::Line;
    QTest::newRow("points") << CurveStyle::Points;
  }
  void theCurvesOfAnXyPlotAreSeen() {
    QFETCH(CurveStyle, style);
    Shown s;
    PaneSpec spec;
    spec.kind = PaneKind::Xy;
    spec.curves << variableCurve("B1/DIST");
    spec.curves[0].inputs << "B1/ANGLE";
    spec.curves[0].style = style;
    s.dock->setLayoutSpec({{PageSpec{"one", {spec}}}, 0});
    s.time.setRange({0.0, 20.0});
    auto* xy = qobject_cast<XyPane*>(s.pane());
    QVERIFY(xy);
    QTRY_VERIFY(!xy->points().empty() && xy->points()[0].size() > 1000);
    const auto pixels = [&] {
      const QImage image = xy->surface()->grab().toImage();
      const QColor wanted = curveColor(0);
      int found = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) found += image.pixelColor(x, y) == wanted;
      }
      return found;
    };
    QTRY_VERIFY2(pixels() > 100, qPrintable(QString::number(pixels())));
    // Taken away: the place is empty again.
    xy->removeCurve(0);
    QTRY_COMPARE(pixels(), 0);
  }

  void anXyPlotNamesBoth() {
    CurveSpec pair = variableCurve(QStringLiteral("B1/TRUE_X"));
    pair.inputs << QStringLiteral("B1/TRUE_Y");
    QCOMPARE(curveName(pair), QStringLiteral("TRUE_Y over TRUE_X B1"));
    pair.inputs[1] = QStringLiteral("B2/TRUE_Y");
    QCOMPARE(curveName(pair), QStringLiteral("TRUE_Y B2 over TRUE_X B1"));
  }

  // The axes named the first robot, whatever the others were.
  void theAxesNameWhatAllCurvesShow() {
    Bench b({QStringLiteral("B1"), QStringLiteral("R2")});
    PaneSpec spec;
    spec.kind = PaneKind::Xy;
    for (const char* group : {"B1", "R2"}) {
      const QString name = QString::fromUtf8(group);
      spec.curves << variableCurve(name + QStringLiteral("/DIST"));
      spec.curves.back().inputs << name + QStringLiteral("/ANGLE");
    }
    b.dock->setLayoutSpec({{PageSpec{QStringLiteral("one"), {spec}}}, 0});
    const auto* xy = qobject_cast<XyPane*>(b.dock->currentPage()->panes()[0]);
    QVERIFY(xy);
    QTRY_COMPARE(xy->titles(), (std::pair{QStringLiteral("DIST"), QStringLiteral("ANGLE")}));
    // They are whole: the plot is high enough for them.
    QVERIFY(xy->surface()->height() >= 150);
  }

  // Beneath an XY plot the clock was taken for its axis.
  void theClockStandsBelowWhatItMeasures_data() {
    QTest::addColumn<bool>("xyFirst");
    QTest::newRow("the XY plot is the last") << false;
    QTest::newRow("the XY plot is the first") << true;
  }
  void theClockStandsBelowWhatItMeasures() {
    QFETCH(bool, xyFirst);
    Bench b;
    b.dock->resize(1000, 400);
    PaneSpec chart, xy;
    chart.curves << variableCurve(QStringLiteral("B1/DIST"));
    xy.kind = PaneKind::Xy;
    xy.curves << variableCurve(QStringLiteral("B1/DIST"));
    xy.curves[0].inputs << QStringLiteral("B1/ANGLE");
    QList<PaneSpec> both{chart, xy};
    if (xyFirst) both.swapItemsAt(0, 1);
    b.dock->setLayoutSpec({{PageSpec{QStringLiteral("one"), both}}, 0});
    const auto* ruler = b.dock->currentPage()->findChild<TimeRuler*>();
    const auto top = [&b](const QWidget* widget) {
      return widget->mapTo(b.dock.get(), QPoint()).y();
    };
    const auto* page = b.dock->currentPage();
    QTRY_VERIFY(ruler->isVisible() && ruler->height() > 0);
    const PlotPane* last = page->panes().last();
    QTRY_COMPARE(top(ruler) < top(page->panes().first()), !xyFirst);
    QTRY_COMPARE(top(ruler) >= top(last) + last->height(), xyFirst);
    // Alone, an XY plot has no clock.
    b.dock->setLayoutSpec({{PageSpec{QStringLiteral("one"), {xy}}}, 0});
    QTRY_VERIFY(!b.dock->currentPage()->findChild<TimeRuler*>()->isVisible());
  }

  void anXyPlotHasEqualScales() {
    Bench b;
    PaneSpec spec;
    spec.kind = PaneKind::Xy;
    spec.curves << variableCurve(QStringLiteral("B1/DIST"));
    spec.curves[0].inputs << QStringLiteral("B1/ANGLE");
    b.dock->setLayoutSpec({{PageSpec{QStringLiteral("one"), {spec}}}, 0});
    auto* xy = qobject_cast<XyPane*>(b.dock->currentPage()->panes()[0]);
    QVERIFY(xy);
    b.time.setRange({0.0, 10.0});
    QTRY_VERIFY(xy->yLimits().high >= 900.0 && xy->xLimits().high < 1000.0);
    const auto* chart = qobject_cast<ValueChart*>(xy->surface()->parentWidget());
    if (chart == nullptr) chart = qobject_cast<ValueChart*>(xy->surface());
    QVERIFY(chart);
    // Of one unit on the screen, across and up.
    const auto ratio = [&] {
      const QRectF area = chart->plotArea();
      return area.width() / (xy->xLimits().high - xy->xLimits().low) /
             (area.height() / (xy->yLimits().high - xy->yLimits().low));
    };
    QVERIFY(std::abs(ratio() - 1.0) > 0.5);
    QMenu menu;
    xy->extendMenu(&menu);
    QAction* equal = menu_entry::called(menu.actions(), QStringLiteral("Equal scales"));
    QVERIFY(equal && !equal->isChecked());
    equal->trigger();
    QVERIFY(xy->spec().equalScales);
    QTRY_VERIFY2(std::abs(ratio() - 1.0) < 1e-6, qPrintable(QString::number(ratio())));
    // What was seen before is still in sight.
    QVERIFY(xy->yLimits().high >= 900.0 && xy->xLimits().low <= 50.0);
  }
};

PITCHBOARD_GUI_TEST(TestXyPlots)

}  // namespace tst_xy_plots

#include "tst_xy_plots.moc"
