// SPDX-License-Identifier: GPL-3.0-or-later
// Value axes and units: what is converted, what goes to the right, what gets a plot of its own.
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

void chooseInPlotMenu(PlotsDock& dock, PlotPane* pane, const QString& text) {
  emit pane->menuRequested(-1, pane->mapToGlobal(QPoint(60, 30)));
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

  void theAxesArePlanned_data() {
    QTest::addColumn<QStringList>("units");
    QTest::addColumn<QString>("plan");  // of each: left or right, factor, ! for a stranger
    QTest::newRow("one") << QStringList{"cm", "cm"} << "cm|: l1 l1";
    QTest::newRow("converted") << QStringList{"m", "cm", "mm"} << "m|: l1 l0.01 l0.001";
    QTest::newRow("two") << QStringList{"cm", "°", "rad", "m"} << "cm|°: l1 r1 r57.2958 l100";
    QTest::newRow("three") << QStringList{"cm", "°", "V"} << "cm|°: l1 r1 r1!";
    QTest::newRow("none is known") << QStringList{"", "m", ""} << "m|: l1 l1 l1";
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
