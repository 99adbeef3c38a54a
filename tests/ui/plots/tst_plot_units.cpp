// SPDX-License-Identifier: GPL-3.0-or-later
// Value axes and units: what is converted, what goes to the right, what gets a plot of its own.
#include <QGraphicsTextItem>
#include <QGraphicsView>
#include <QJsonDocument>
#include <QtTest>

#include <ui/base/theme.h>

#include "../support/menu_entry.h"
#include "axis_units.h"
#include "chart_pane.h"
#include "plot_rig.h"
#include "xy_pane.h"

namespace tst_plot_units {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;
using Side = CurveSpec::Side;

namespace {

/// A robot with a column of each of these units: U0, U1, ... Column i is (i + 1) × 100 throughout.
void addUnits(PlotSource& source, const QStringList& units) {
  telemetry::GroupInfo info;
  info.name = "B9";
  std::vector<double> values;
  for (const QString& unit : units) {
    values.push_back(100.0 * static_cast<double>(values.size() + 1));
    info.columns.push_back({"U" + std::to_string(info.columns.size()),
                            telemetry::ColumnType::Float64,
                            unit.toStdString(),
                            "",
                            {},
                            {}});
  }
  const auto group = source.store->addGroup(info);
  for (int i = 0; i <= 100; ++i) source.store->append(group, {i * 0.1, {}, values});
}

struct Units : Bench {
  explicit Units(const QStringList& units) : Bench(QStringList{}) {
    addUnits(source, units);
    dock->feed()->refresh();
    for (int i = 0; i < units.size(); ++i) names << QStringLiteral("B9/U%1").arg(i);
  }
  ChartPane* chart(int i = 0) {
    return qobject_cast<ChartPane*>(dock->currentPage()->panes().value(i));
  }
  QStringList names;
};

void chooseInPlotMenu(PlotsDock& dock, PlotPane* pane, const QString& text, int curve = -1) {
  emit pane->menuRequested(curve, pane->mapToGlobal(QPoint(60, 30)));
  auto* menu = dock.findChild<QMenu*>(QStringLiteral("plotMenu"));
  QVERIFY(menu);
  QAction* action = menu_entry::called(menu->actions(), text);
  QVERIFY2(action, qPrintable(text));
  action->trigger();
  menu->close();
}

}  // namespace

class TestPlotUnits : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  // DIST is 100 + 50 sin t: highest at 1.57 s and 7.85 s, lowest at 4.71 s.
  void aCurvesExtremesAreReached() {
    Bench b;
    b.source.goTo(10.0);
    PlotPane* pane = b.show(variableCurve(QStringLiteral("B1/DIST")));
    b.dock->feed()->refresh();
    QTRY_VERIFY(!pane->curves()[0].isWaiting());
    const auto isAt = [&](double time) { return std::abs(b.sources.time() - time) < 0.02; };
    chooseInPlotMenu(*b.dock, pane, QStringLiteral("Go to minimum"), 0);
    QVERIFY2(isAt(4.71), qPrintable(QString::number(b.sources.time())));
    b.sources.setSelection(telemetry::TimeRange{0.0, 4.0});
    chooseInPlotMenu(*b.dock, pane, QStringLiteral("Go to maximum"), 0);
    QVERIFY2(isAt(1.57), qPrintable(QString::number(b.sources.time())));
    b.sources.setSelection(telemetry::TimeRange{5.0, 10.0});
    chooseInPlotMenu(*b.dock, pane, QStringLiteral("Go to maximum"), 0);
    QVERIFY2(isAt(7.85), qPrintable(QString::number(b.sources.time())));
  }

  void theAxesArePlanned_data() {
    QTest::addColumn<QStringList>("units");
    QTest::addColumn<QString>("plan");  // of each: left or right, factor, ! for a stranger
    QTest::newRow("one") << QStringList{"cm", "cm"} << "cm|: l1 l1";
    QTest::newRow("converted") << QStringList{"m", "cm", "mm"} << "m|: l1 l0.01 l0.001";
    QTest::newRow("two") << QStringList{"cm", "°", "rad", "m"} << "cm|°: l1 r1 r57.2958 l100";
    QTest::newRow("three") << QStringList{"cm", "°", "V"} << "cm|°: l1 r1 r1!";
    QTest::newRow("none is known") << QStringList{"", "m", ""} << "m|: r1 l1 r1";
    QTest::newRow("unknown beside two") << QStringList{"cm", "°", ""} << "cm|°: l1 r1 r1!";
    QTest::newRow("all unknown") << QStringList{"", ""} << "|: l1 l1";
    QTest::newRow("a team's own") << QStringList{"bananas", "bananas", "apples"}
                                  << "bananas|apples: l1 l1 r1";
    QTest::newRow("speeds") << QStringList{"m/s", "cm/s", "°/s"} << "m/s|°/s: l1 l0.01 r1";
    QTest::newRow("by hand") << QStringList{"cm>", "cm", "°"} << "cm|cm: r1 l1 r1!";
    QTest::newRow("by hand to the left") << QStringList{"cm", "°<", "V"} << "cm|V: l1 l1! r1";
  }
  void theAxesArePlanned() {
    QFETCH(QStringList, units);
    QFETCH(QString, plan);
    std::vector<AxisRequest> requests;
    for (QString unit : units) {
      const Side side = unit.endsWith('>')   ? Side::Right
                        : unit.endsWith('<') ? Side::Left
                                             : Side::ByUnit;
      if (side != Side::ByUnit) unit.chop(1);
      requests.push_back({unit, side});
    }
    const AxisPlan made = planAxes(requests);
    QString text = made.left + QLatin1Char('|') + made.right + QLatin1Char(':');
    for (const AxisPlan::Place& place : made.places) {
      text += QStringLiteral(" %1%2%3")
                  .arg(place.right ? 'r' : 'l')
                  .arg(place.factor)
                  .arg(place.otherUnit ? QStringLiteral("!") : QString());
    }
    QCOMPARE(text, plan);
  }

  void centimetresJoinMetres() {
    Units b({"m", "cm"});  // 100 m and 200 cm
    b.dock->plotVariables(b.names);
    QCOMPARE(b.dock->currentPage()->panes().size(), 1);
    ChartPane* chart = b.chart();
    QVERIFY(!chart->hasRightAxis());
    b.time.setRange({0.0, 10.0});
    // 200 cm are 2 m at this axis, not 200.
    QTRY_VERIFY(chart->valueScale().limits.high < 120.0);
    QVERIFY(chart->valueScale().limits.low <= 2.0);
    QCOMPARE(chart->axes().left, QStringLiteral("m"));
    const LegendEntry entry = chart->legend()->entries().value(1);
    QCOMPARE(entry.side, QStringLiteral("[cm]"));  // its numbers are still its own
    QCOMPARE(entry.value, QStringLiteral("200.0"));
    QCOMPARE(chart->legend()->entries().value(0).side, QString());
  }

  void degreesGoRight() {
    Units b({"cm", "°", "rad"});
    b.dock->plotVariables(b.names);
    QCOMPARE(b.dock->currentPage()->panes().size(), 1);
    ChartPane* chart = b.chart();
    QVERIFY(chart->hasRightAxis());
    QCOMPARE(chart->axes().right, QStringLiteral("°"));
    QCOMPARE(chart->legend()->entries().value(1).side, QStringLiteral("right"));
    QCOMPARE(chart->legend()->entries().value(2).side, QStringLiteral("right [rad]"));
    b.time.setRange({0.0, 10.0});
    QTRY_VERIFY(chart->rightScale().limits.high > 10'000.0);  // 300 rad
    QVERIFY(chart->valueScale().limits.high < 200.0);
  }

  void aThirdUnitGetsItsOwnChart() {
    Units b({"cm", "°", "V", "m"});
    // One after the other, and at once on the first chart: the same.
    for (const QString& name : b.names) b.dock->plotVariables({name});
    const auto shown = [&b] {
      QList<QStringList> all;
      for (const PlotPane* pane : b.dock->currentPage()->panes()) all << namesOf(pane);
      return all;
    };
    QCOMPARE(shown().size(), 2);
    QCOMPARE(shown().value(1).front(), QStringLiteral("U2 B9"));
    b.dock->currentPage()->removeAll();
    dropOn(b.dock->currentPage(), b.names, b.dock->currentPage()->rect().center());
    QCOMPARE(shown(), (QList<QStringList>{{"U0 B9", "U1 B9", "U3 B9"}, {"U2 B9"}}));
    QCoreApplication::processEvents();
    dropOn(b.dock->currentPage(), {b.names[2]},
           b.chart()->mapTo(b.dock->currentPage(), b.chart()->rect().center()));
    QCOMPARE(shown().size(), 3);
    // One that is loaded stays where it was, with its unit said.
    PaneSpec loaded;
    for (const QString& name : b.names) loaded.curves << variableCurve(name);
    b.dock->setLayoutSpec({{{QStringLiteral("one"), {loaded}}}, 0});
    QCOMPARE(shown().size(), 1);
    const LegendEntry stranger = b.chart()->legend()->entries().value(2);
    QVERIFY(stranger.odd);
    QCOMPARE(stranger.side, QStringLiteral("right [V]"));
  }

  /// It was drawn flat on the axis of the others.
  void aComputedCurveIsReadAtItsOwnUnit() {
    Units b({"cm", "°"});  // 100 cm and 200 °
    PaneSpec spec;
    spec.curves << variableCurve(b.names[0]) << expression(QStringLiteral("B9.U0 / 50 + t"))
                << expression(QStringLiteral("B9.U0 / 100 + 0"));
    auto* chart = qobject_cast<ChartPane*>(b.dock->currentPage()->insertPane(0, spec));
    const auto planned = [&] {
      b.dock->feed()->refresh();
      return chart->axes().places.size() == 3 && chart->curves()[1].view() &&
             chart->curves()[2].view() && chart->hasRightAxis();
    };
    QTRY_VERIFY(planned());
    // The unit of cm and s together is unknown: an axis of its own.
    QVERIFY(chart->axes().places[1].right);
    QCOMPARE(chart->curves()[1].unit(), QString());
    // Metres are read at the centimetres, a hundred of them for each.
    QCOMPARE(chart->curves()[2].unit(), QStringLiteral("m"));
    QVERIFY(!chart->axes().places[2].right);
    QCOMPARE(chart->axes().places[2].factor, 100.0);
  }

  /// A flat curve at the limit lay under the frame, and a low plot had one number or none.
  void everyCurveAndTwoNumbersAreSeen_data() {
    QTest::addColumn<int>("height");
    for (const int height : {55, 60, 72, 85, 110, 200}) QTest::addRow("%d px", height) << height;
  }
  void everyCurveAndTwoNumbersAreSeen() {
    QFETCH(int, height);
    Units b({"cm", "°"});  // 100 and 200
    b.dock->plotVariables({b.names[0]});
    ChartPane* chart = b.chart();
    b.time.setRange({0.0, 10.0});
    b.dock->resize(700, 500);
    QCoreApplication::processEvents();
    chart->setFixedHeight(height + chart->legend()->height());
    QCoreApplication::processEvents();
    const auto numbers = [chart] {
      int seen = 0;
      for (const QGraphicsItem* item : chart->findChild<QGraphicsView*>()->scene()->items()) {
        const auto* text = qgraphicsitem_cast<const QGraphicsTextItem*>(item);
        const bool isNumber =
            text != nullptr && text->isVisible() && !text->toPlainText().isEmpty() &&
            (text->toPlainText().back().isDigit() || text->toPlainText().back() == '.');
        const QRectF place = isNumber ? text->sceneBoundingRect() : QRectF();
        if (isNumber && place.bottom() > 0 && place.left() < 100) ++seen;
      }
      return seen;
    };
    for (const auto& [low, high] :
         {std::pair(0.0, 0.0), {0.0, 100.0}, {37.0, 151.0}, {99.0, 108.0}, {3.0, 1000.0}}) {
      PaneSpec options = chart->spec();
      options.autoValues = low == high;
      // Qt hides numbers at the very limits, which only a higher plot has others beside.
      if (!options.autoValues && height < 110) continue;
      options.values = {low, high};
      chart->setOptions(options);
      QCoreApplication::processEvents();
      QVERIFY2(
          numbers() >= 2,
          qPrintable(QStringLiteral("%1 numbers from %2 to %3").arg(numbers()).arg(low).arg(high)));
    }
    PaneSpec options = chart->spec();
    options.autoValues = true;
    chart->setOptions(options);
    const ValueScale scale = chart->valueScale();
    QVERIFY(scale.bottom - scale.top >= height - 16);
    const double y = scale.toY(100.0);
    QVERIFY(y > scale.top + 2 && y < scale.bottom - 2);
  }

  void theChosenAxisIsKept() {
    Units b({"cm", "cm"});
    b.dock->plotVariables(b.names);
    ChartPane* chart = b.chart();
    CurveSpec spec = chart->description(1);
    spec.side = Side::Right;
    chart->setCurve(1, spec);
    QVERIFY(chart->hasRightAxis() && chart->axes().places[1].right);
    const QByteArray text = QJsonDocument(toJson(b.dock->layoutSpec())).toJson();
    const auto read = layoutFromText({text.data(), std::size_t(text.size())}, "test");
    QVERIFY(read && read->pages[0].panes[0].curves[1].side == Side::Right);
  }

  void filesOf08StayAsTheyWere() {
    const auto read = layoutFromText(
        R"({"pitchboardPlots": 1, "tabs": [{"name": "a", "plots": [{"kind": "chart", "curves": [
            {"kind": "variable", "inputs": ["B1/DIST"]},
            {"kind": "variable", "inputs": ["B1/ANGLE"], "rightAxis": true}]}]}]})",
        "test");
    QVERIFY(read);
    QCOMPARE(read->pages[0].panes[0].curves[0].side, Side::ByUnit);
    QCOMPARE(read->pages[0].panes[0].curves[1].side, Side::Right);
  }

  void limitsAreOfTheShownUnit() {
    Units b({"m", "cm"});
    b.dock->plotVariables(b.names);
    PaneSpec options = b.chart()->spec();
    options.autoValues = false;
    options.values = {0.0, 4.0};  // m
    b.chart()->setOptions(options);
    b.time.setRange({0.0, 10.0});
    // The curve of 200 cm stands at 2 m: the middle.
    const QImage image = b.chart()->surface()->grab().toImage();
    const ValueScale scale = b.chart()->valueScale();
    const QColor color = b.chart()->curves()[1].color();
    const int x = qRound(b.chart()->timeAxis().pixel(5.0));
    const auto near = [&](double y) {
      for (int dy = -2; dy <= 2; ++dy) {
        const QColor at = image.pixelColor(x, qRound(y) + dy);
        if (std::abs(at.hslHue() - color.hslHue()) < 12 && at.hslSaturation() > 60) return true;
      }
      return false;
    };
    QVERIFY(near(scale.toY(2.0)));
    QVERIFY(!near(scale.toY(1.0)));
  }

  void computedCurvesOverEachOther() {
    Bench b;
    CurveSpec speed = variableCurve(QStringLiteral("B1/DIST"));
    speed.kind = CurveKind::Derivative;
    PaneSpec spec;
    spec.curves << variableCurve(QStringLiteral("B1/DIST")) << speed;
    PlotPane* pane = b.dock->currentPage()->insertPane(0, spec);
    b.time.setRange({0.0, 10.0});
    chooseInPlotMenu(*b.dock, pane, QStringLiteral("Show as XY plot"));
    QCOMPARE(b.dock->currentPage()->panes().size(), 2);
    const auto* xy = qobject_cast<XyPane*>(b.dock->currentPage()->panes()[1]);
    QVERIFY(xy);
    QTRY_VERIFY(!xy->points().empty() && xy->points()[0].size() > 100);
    QCOMPARE(namesOf(xy).front(), QStringLiteral("d/dt DIST B1 over DIST B1"));
  }
};

PITCHBOARD_GUI_TEST(TestPlotUnits)

}  // namespace tst_plot_units

#include "tst_plot_units.moc"
