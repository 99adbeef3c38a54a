// SPDX-License-Identifier: GPL-3.0-or-later
// Derived curves, expressions, layouts as values and files, exports, divisions of axes.

#include <QBuffer>
#include <QCheckBox>
#include <QJsonDocument>
#include <QLabel>
#include <QLineEdit>
#include <QtTest>
#include <numbers>

#include <ui/plots/axis_ticks.h>
#include <ui/plots/plots_dock.h>

#include "curve.h"
#include "curve_dialog.h"
#include "expression.h"
#include "plot_export.h"
#include "plot_page.h"
#include "plot_presets.h"
#include "plot_source.h"

namespace tst_plot_curves {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

CurveSpec derivedOf(CurveKind kind, double parameter = 0.0) {
  CurveSpec spec = variableCurve("B1/ANGLE");
  spec.kind = kind;
  spec.parameter = parameter;
  return spec;
}

/// Every sample of a curve when its work is done.
std::vector<telemetry::Sample> allOf(Curve& curve, PlotFeed& feed, std::size_t wanted) {
  std::vector<telemetry::Sample> samples;
  (void)QTest::qWaitFor([&] {
    feed.refresh();
    curve.update(feed);
    samples.clear();
    if (curve.view()) curve.view().group->samples(curve.view().column, {-1e9, 1e9}, samples);
    return samples.size() >= wanted;
  });
  return samples;
}

}  // namespace

class TestPlotCurves : public QObject {
  Q_OBJECT

 private slots:
  void derivedCurves_data() {
    QTest::addColumn<CurveSpec>("spec");
    QTest::addColumn<double>("atTwoSeconds");  // ANGLE is 90 t
    QTest::addColumn<QString>("unit");
    QTest::newRow("derivative") << derivedOf(CurveKind::Derivative) << 90.0 << "°/s";
    QTest::newRow("integral") << derivedOf(CurveKind::Integral) << 180.0 << "°·s";
    // The mean of the 30 samples in (1.5, 2]: their middle lies a quarter second less half a tick
    // ago.
    QTest::newRow("average") << derivedOf(CurveKind::MovingAverage, 0.5)
                             << 90.0 * (2.0 - 0.25 + 0.5 / 60) << "°";
    QTest::newRow("wrap") << derivedOf(CurveKind::WrapAngle, 360.0) << 180.0 << "°";
    QTest::newRow("wrap small turn") << derivedOf(CurveKind::WrapAngle, 100.0) << -20.0 << "°";
    CurveSpec radians = derivedOf(CurveKind::Conversion, std::numbers::pi / 180);
    radians.unit = "rad";
    QTest::newRow("conversion") << radians << std::numbers::pi << "rad";
    CurveSpec difference = derivedOf(CurveKind::Difference);
    difference.inputs << "B1/DIST";
    QTest::newRow("difference") << difference << 180.0 - PlotSource::distanceAt(2.0)
                                << "";  // of ° and cm
    CurveSpec expression;
    expression.kind = CurveKind::Expression;
    expression.expression = "hypot(B1.ANGLE, {B2/DIST}) + t";
    QTest::newRow("expression") << expression << std::hypot(180.0, PlotSource::distanceAt(2.0)) + 2
                                << "";
    expression.expression = "B1.DIST / 100 * t";
    QTest::newRow("expression in m·s")
        << expression << PlotSource::distanceAt(2.0) / 100 * 2 << "m·s";
  }
  void derivedCurves() {
    QFETCH(CurveSpec, spec);
    QFETCH(double, atTwoSeconds);
    QFETCH(QString, unit);
    PlotBench bench;
    bench.source.fill("B2", 4.0);
    bench.source.fill("B1", 2.0);
    PlotFeed feed(&bench.source, &bench.time);
    Curve curve(spec);
    auto samples = allOf(curve, feed, 121);
    QCOMPARE(samples.size(), std::size_t(121));
    QCOMPARE(samples.back().time, 2.0);
    QVERIFY2(std::abs(samples.back().value - atTwoSeconds) < 1e-6,
             qPrintable(QString::number(samples.back().value, 'g', 12)));
    QCOMPARE(curve.unit(), unit);
    // What comes later is only added.
    const telemetry::GroupId group = *bench.source.store->findGroup("B1");
    for (int i = 121; i <= 240; ++i) {
      bench.source.append(group, i / 60.0, 0, PlotSource::distanceAt(i / 60.0), 90.0 * i / 60.0);
    }
    const auto more = allOf(curve, feed, 241);
    QCOMPARE(more.size(), std::size_t(241));
    QCOMPARE(more[120].value, samples[120].value);
    // A source that was put back: computed again, no rows of the future stay.
    bench.source.append(group, 1.0, 0, 0.0, 0.0);
    const auto endIsOne = [&] {
      feed.refresh();
      curve.update(feed);
      return curve.view() && curve.view().group->range()->end == 1.0;
    };
    QTRY_VERIFY(endIsOne());
  }

  /// The source is put back and is further than before when somebody looks again.
  void anAbandonedFutureIsNotKept() {
    PlotBench bench;
    bench.source.fill("B1", 4.0);
    PlotFeed feed(&bench.source, &bench.time);
    Curve curve(derivedOf(CurveKind::Derivative));
    QCOMPARE(allOf(curve, feed, 241).size(), std::size_t(241));
    const telemetry::GroupId group = *bench.source.store->findGroup("B1");
    for (int i = 60; i <= 300; ++i) {
      bench.source.append(group, i / 60.0, 0, 0.0, 90.0 - (i - 60) * 3.0);
    }
    const auto isNew = [&] {
      feed.refresh();
      curve.update(feed);
      if (!curve.view() || curve.view().group->rows() != 301) return false;
      const auto then = curve.view().group->at(curve.view().column, 3.0);
      return then && std::abs(then->value + 180.0) < 1e-6;
    };
    QTRY_VERIFY(isNew());
  }

  void invalidExpressionsAreReported_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("hasText");
    QTest::newRow("empty") << "  "
                           << "empty";
    QTest::newRow("no variable") << "1 + 2"
                                 << "no variable";
    QTest::newRow("no group") << "VISION_BALL_DIST * 2"
                              << "VISION_BALL_DIST";
    QTest::newRow("open") << "(B1.X + 2"
                          << "')' is missing";
    QTest::newRow("operator") << "B1.X + * 2"
                              << "character 8";
    QTest::newRow("function") << "sinus(B1.X)"
                              << "'sinus' at character 1";
    QTest::newRow("arguments") << "hypot(B1.X)"
                               << "hypot";
    QTest::newRow("brace") << "{B1/X + 2"
                           << "brace";
    QTest::newRow("brace without group") << "{X}"
                                         << "GROUP/NAME";
    QTest::newRow("assignment") << "B1.X = 4"
                                << "character 6";
    QTest::newRow("too long") << QString(5000, QLatin1Char('1')) << "longer";
    QTest::newRow("odd characters")
        << QString::fromUtf8("B1.X + §ß") << QString::fromUtf8("'§' at character 8");
  }
  void invalidExpressionsAreReported() {
    QFETCH(QString, text);
    QFETCH(QString, hasText);
    const auto parsed = PlotExpression::parse(text);
    QVERIFY(!parsed);
    QVERIFY2(QString::fromStdString(parsed.error().message).contains(hasText, Qt::CaseInsensitive),
             parsed.error().message.c_str());
    // In a plot the sentence stands in the legend, and in the dialog it keeps OK away.
    PlotBench bench;
    PlotFeed feed(&bench.source, &bench.time);
    CurveSpec spec;
    spec.kind = CurveKind::Expression;
    spec.expression = text.trimmed();
    Curve curve(spec);
    curve.update(feed);
    QVERIFY(curve.isFaulty() && !curve.note().isEmpty());
    CurveDialog dialog(&feed, spec, nullptr);
    QVERIFY(!dialog.problem().isEmpty());
  }

  void expressionsCompute_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<double>("value");  // B1.A = 3, B1.B = 4, t = 2
    QTest::newRow("arithmetic") << "B1.A * 2 - B1.B / 8 + 2 ^ 3" << 13.5;
    QTest::newRow("functions") << "hypot(B1.A, B1.B) + sqrt(16) + 0 * B1.A" << 9.0;
    QTest::newRow("condition") << "B1.A > 2 ? B1.B : -1" << 4.0;
    QTest::newRow("angles") << "deg(pi) + wrap(B1.A * 100, 360) + rad(0)" << 120.0;
    QTest::newRow("time") << "t * B1.A" << 6.0;
    QTest::newRow("braces") << "{B1/A} + {B1/B}" << 7.0;
    QTest::newRow("division by zero")
        << "B1.A / (B1.B - 4)" << std::numeric_limits<double>::infinity();
  }
  void expressionsCompute() {
    QFETCH(QString, text);
    QFETCH(double, value);
    auto expression = PlotExpression::parse(text);
    QVERIFY2(expression.has_value(), expression ? "" : expression.error().message.c_str());
    std::vector<double> values;
    for (const QString& name : expression->variables()) values.push_back(name == "B1/A" ? 3 : 4);
    QCOMPARE(expression->evaluate(2.0, values), value);
  }

  void layoutsGoThroughFiles() {
    PlotLayout layout;
    PaneSpec pane;
    pane.title = "Ball";
    pane.autoValues = false;
    pane.values = {-1.5, 300};
    CurveSpec curve = derivedOf(CurveKind::MovingAverage, 0.75);
    curve.color = QColor("#123456");
    curve.style = CurveStyle::LineAndPoints;
    curve.width = 2.5;
    curve.title = "mean";
    pane.curves << curve << variableCurve("B1/DIST");
    PaneSpec xy;
    xy.kind = PaneKind::Xy;
    xy.equalScales = true;
    xy.curves << variableCurve("B1/X");
    xy.curves[0].inputs << "B1/Y";
    PaneSpec lane;
    lane.kind = PaneKind::Lane;
    lane.share = 20;
    lane.curves << variableCurve("B1/ACTION");
    layout.pages << PageSpec{"näme", {pane, xy, lane}} << PageSpec{"empty", {}};
    layout.current = 1;
    QTemporaryDir folder;
    const QString path = folder.filePath("plots.json");
    QVERIFY(PlotPresets::writeFile(path, layout).has_value());
    const auto read = PlotPresets::readFile(path);
    QVERIFY2(read.has_value(), read ? "" : read.error().text().c_str());
    QVERIFY(*read == layout);

    QSettings settings(folder.filePath("s.ini"), QSettings::IniFormat);
    PlotPresets presets(&settings);
    presets.save("a/b", layout);
    presets.save("other", {});
    QCOMPARE(presets.names(), QStringList({"a/b", "other"}));
    QVERIFY(*presets.load("a/b") == layout);
    presets.remove("a/b");
    QVERIFY(!presets.load("a/b"));
    QVERIFY(!PlotPresets::writeFile("/nowhere/at/all.json", layout));
  }

  void brokenLayoutsAreRefused_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("hasText");
    QTest::newRow("no json") << QByteArray("hello") << "plots.json:1: not valid JSON";
    QTest::newRow("other json") << QByteArray("{\"a\": 1}") << "not a layout";
    QTest::newRow("later") << QByteArray("{\"pitchboardPlots\": 7}") << "version 7";
    QTest::newRow("kind")
        << QByteArray(R"({"pitchboardPlots":1,"tabs":[{"plots":[{"kind":"pie"}]}]})")
        << "plots.json:1: tabs[0].plots[0].kind: there is no kind of plot \"pie\"";
    QTest::newRow("inputs") << QByteArray(R"({"pitchboardPlots":1,"tabs":[{"plots":[{"curves":
        [{"kind":"difference","inputs":["B1/X"]}]}]}]})")
                            << "plots.json:2: tabs[0].plots[0].curves[0].inputs: needs 2";
    QTest::newRow("limits") << QByteArray(R"({"pitchboardPlots":1,"tabs":[{"plots":[
        {"values":[3,1]}]}]})")
                            << "values";
  }
  void brokenLayoutsAreRefused() {
    QFETCH(QByteArray, text);
    QFETCH(QString, hasText);
    QTemporaryDir folder;
    QFile file(folder.filePath("plots.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    const auto read = PlotPresets::readFile(file.fileName());
    QVERIFY(!read);
    QVERIFY2(QString::fromStdString(read.error().text()).contains(hasText),
             read.error().text().c_str());
  }

  void exports() {
    PlotBench bench;
    bench.source.fill("B1", 2.0);
    PlotsDock dock(bench.context(), nullptr);
    dock.resize(800, 300);
    dock.show();
    dock.feed()->refresh();
    dock.currentPage()->addVariables({"B1/DIST", "B1/ANGLE"});
    const auto panes = dock.currentPage()->panes();
    QBuffer csv;
    csv.open(QIODevice::ReadWrite);
    writeCsv(csv, panes, {0.5, 1.0});
    const QList<QByteArray> lines = csv.data().split('\n');
    QCOMPARE(lines[0], QByteArray("time [s],DIST B1 [cm],ANGLE B1 [\xc2\xb0]\r"));
    QCOMPARE(lines.size(), 31 + 2);
    const QList<QByteArray> cells = lines[1].trimmed().split(',');
    QCOMPARE(cells[0].toDouble(), 0.5);
    QCOMPARE(cells[1].toDouble(), PlotSource::distanceAt(0.5));
    QCOMPARE(cells[2].toDouble(), 45.0);
    QVERIFY(valuesText(panes, 0.5).startsWith("DIST B1\t"));

    QTemporaryDir folder;
    const QString png = folder.filePath("a.png");
    QVERIFY(savePlotPicture(plotPng(*dock.currentPage()), png).has_value());
    QCOMPARE(QImage(png).width(), 2 * dock.currentPage()->picture()->width());
    const QString svg = folder.filePath("a.svg");
    QVERIFY(savePlotPicture(plotSvg(*dock.currentPage()), svg).has_value());
    QFile drawing(svg);
    QVERIFY(drawing.open(QIODevice::ReadOnly));
    const QByteArray text = drawing.readAll();
    QVERIFY(text.contains("<polyline") || text.contains("<path"));
    QVERIFY2(!text.contains("<image"), "curves went into the drawing as a picture");
    const auto refused = savePlotCsv(panes, {0, 1}, "/nowhere/at/all.csv");
    QVERIFY(!refused && !refused.error().message.empty());
  }

  void axesAreDividedNicely() {
    QCOMPARE(niceStep(10, 5), 2.0);
    QCOMPARE(niceStep(0.37, 4), 0.1);
    QVERIFY(niceLimits(17, 295, 3).limits == (ValueLimits{0, 300}));
    QVERIFY(niceLimits(5, 5, 4).limits.low < 5 && niceLimits(5, 5, 4).limits.high > 5);
    QVERIFY(niceLimits(0, 0, 4).limits == (ValueLimits{-1, 1}));
    // A value at a limit is not hidden by the frame.
    const ValueLimits roomy = niceLimits(0, 100, 2, 0.05).limits;
    QVERIFY(roomy.low <= -5 && roomy.high >= 105);
    QVERIFY(niceLimits(20, 80, 2, 0.05).limits == (ValueLimits{0, 100}));
    QCOMPARE(decimalsOf(0.05), 2);
    QCOMPARE(decimalsOf(20), 0);
  }

  /// One number says nothing about a scale.
  void twoNumbersLieWithinAnyLimits() {
    for (int most = 1; most <= 12; ++most) {
      for (double low = -130.0; low < 130.0; low += 7.3) {
        for (const double span : {0.004, 0.37, 1.0, 9.99, 41.0, 1e6}) {
          const double step = labelStep({low, low + span}, most);
          const double first = std::ceil(low / step - 1e-9) * step;
          QVERIFY2(first + step <= low + span + 1e-9 * span,
                   qPrintable(QStringLiteral("%1 + %2, %3").arg(low).arg(span).arg(most)));
        }
      }
    }
  }

  void limitsAreTypedWithCommaOrPoint() {
    AxesDialog dialog({}, {0.0, 1.0}, {}, nullptr);
    dialog.show();
    dialog.findChild<QCheckBox*>(QStringLiteral("fixedLimits"))->setChecked(true);
    const auto type = [&dialog](const char* box, const QString& number) {
      auto* edit = dialog.findChild<QLineEdit*>(QLatin1String(box));
      edit->selectAll();
      QTest::keyClicks(edit, number);
    };
    type("lowLimit", QStringLiteral("-1,25"));
    type("highLimit", QStringLiteral("2.5"));
    QCOMPARE(dialog.pane().values, (ValueLimits{-1.25, 2.5}));
    auto* problem = dialog.findChild<QLabel*>(QStringLiteral("problem"));
    QVERIFY(problem->text().isEmpty());
    type("lowLimit", QStringLiteral("1,2,3"));
    QVERIFY(!problem->text().isEmpty());
  }
};

PITCHBOARD_GUI_TEST(TestPlotCurves)

}  // namespace tst_plot_curves

#include "tst_plot_curves.moc"
