// SPDX-License-Identifier: GPL-3.0-or-later
// The plots' dock with real drops, wheels and drags, against values computed here.

#include <QMimeData>
#include <QPainter>
#include <QScreen>
#include <QtTest>

#include <simcore/world/action_codes.h>
#include <telemetry/series/series_pages.h>
#include <ui/base/theme.h>
#include <ui/base/variable_names.h>
#include <ui/plots/plots_dock.h>

#include "chart_pane.h"
#include "lane_pane.h"
#include "legend_bar.h"
#include "marks_model.h"
#include "marks_panel.h"
#include "plot_page.h"
#include "plot_rig.h"
#include "plot_source.h"
#include "time_ruler.h"
#include "xy_pane.h"

namespace tst_plots {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;

class TestPlots : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aDropMakesACurveWithTheData() {
    Shown s;
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    QVERIFY(chart);
    QCOMPARE(chart->curves().size(), std::size_t(1));
    QCOMPARE(chart->curves()[0].unit(), QStringLiteral("cm"));
    s.time.setRange({10.0, 11.0});
    QTRY_COMPARE(chart->traces().size(), std::size_t(1));
    QTRY_VERIFY(chart->traces()[0].exact && chart->traces()[0].samples.size() >= 61);
    for (const auto& sample : chart->traces()[0].samples) {
      QCOMPARE(sample.value, PlotSource::distanceAt(sample.time));
    }
    // On the plot: one more curve. At the lower edge: a plot of its own.
    dropOn(s.page(), {"B1/ANGLE"}, s.middleOf(chart));
    QCOMPARE(s.page()->panes().size(), 1);
    QCOMPARE(chart->curves().size(), std::size_t(2));
    QVERIFY(chart->curves()[0].color() != chart->curves()[1].color());
    dropOn(s.page(), {"B1/NOISY"}, QPoint(100, s.page()->height() - 3));
    QCOMPARE(s.page()->panes().size(), 2);
  }

  // It looked as if the drop had missed.
  void whatIsPlottedAlreadyStandsOutAndIsReported() {
    Shown s;
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    QSignalSpy noted(s.dock.get(), &PlotsDock::noted);
    const auto said = [&noted] {
      return noted.isEmpty() ? QString() : noted.takeLast().front().toString();
    };
    const QImage before = chart->grab().toImage();
    dropOn(s.page(), {"B1/DIST"}, s.middleOf(chart));
    QCOMPARE(chart->curves().size(), std::size_t(1));
    QCOMPARE(said(), QStringLiteral("DIST B1 is already plotted"));
    QVERIFY(chart->isPointedOut(0) && chart->legend()->entries()[0].pointedOut);
    QVERIFY(chart->grab().toImage() != before);
    QTRY_VERIFY(!chart->isPointedOut(0) && !chart->legend()->entries()[0].pointedOut);
    QCOMPARE(chart->grab().toImage(), before);
    // While it is dragged, too.
    const auto hintOver = [&](const QStringList& names) {
      QMimeData data;
      data.setData(variablesMimeType, names.join('\n').toUtf8());
      QDragEnterEvent enter(s.middleOf(chart), Qt::CopyAction, &data, Qt::LeftButton, {});
      QApplication::sendEvent(s.page(), &enter);
      QDragMoveEvent move(s.middleOf(chart), Qt::CopyAction, &data, Qt::LeftButton, {});
      QApplication::sendEvent(s.page(), &move);
      const auto hint = s.page()->findChild<TimeLines*>()->hint();
      return hint ? hint->text : QString();
    };
    QCOMPARE(hintOver({"B1/DIST"}), QStringLiteral("already in this plot"));
    QCOMPARE(hintOver({"B1/DIST", "B1/ANGLE"}), QStringLiteral("add to this plot"));
    // A new one of two is added, and only the other one is reported.
    dropOn(s.page(), {"B1/DIST", "B1/ANGLE"}, s.middleOf(chart));
    QCOMPARE(chart->curves().size(), std::size_t(2));
    QCOMPARE(said(), QStringLiteral("DIST B1 is already plotted"));
    // One that was hidden is shown again.
    chart->toggleCurve(0);
    QVERIFY(chart->curves()[0].isHidden());
    dropOn(s.page(), {"B1/DIST"}, s.middleOf(chart));
    QVERIFY(!chart->curves()[0].isHidden());
    // A double click in Variables, whichever plot has it.
    dropOn(s.page(), {"B1/NOISY"}, QPoint(100, s.page()->height() - 3));
    dropOn(s.page(), {"B1/ACTION"}, QPoint(100, s.page()->height() - 3));
    QCOMPARE(s.page()->panes().size(), 3);
    noted.clear();
    s.target.plotVariables({"B1/DIST", "B1/ACTION"});
    QCOMPARE(said(), QStringLiteral("2 variables are already plotted"));
    QVERIFY(chart->isPointedOut(0));
    QCOMPARE(s.page()->panes().size(), 3);
    QCOMPARE(chart->curves().size(), std::size_t(2));
    QCOMPARE(s.pane(1)->curves().size(), std::size_t(1));
    // A plot of its own is what somebody wants who drops between two.
    dropOn(s.page(), {"B1/DIST"}, QPoint(100, s.page()->height() - 3));
    QCOMPARE(s.page()->panes().size(), 4);
    QVERIFY(noted.isEmpty());
  }

  void otherDropsAreRefused() {
    Shown s;
    QMimeData data;
    data.setText("B1/DIST");
    QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, {});
    enter.ignore();
    QApplication::sendEvent(s.page(), &enter);
    QVERIFY(!enter.isAccepted());
    QMimeData odd;
    odd.setData(variablesMimeType, "\n  \nnogroup\n/x\nB1/DIST\nB1/DIST\n\xff\xfe/\n");
    QCOMPARE(draggedVariables(&odd).first(), QStringLiteral("B1/DIST"));
    QVERIFY(draggedVariables(nullptr).isEmpty());
  }

  void otherDocksCanSendVariables() {
    Shown s;
    s.target.plotVariables({"B1/DIST", "B1/ACTION", "B1/ANGLE"});
    QCOMPARE(s.page()->panes().size(), 2);
    QCOMPARE(s.pane(0)->curves().size(), std::size_t(2));
    QCOMPARE(s.pane(1)->kind(), PaneKind::Lane);
  }

  void liveCurvesFollow() {
    Shown s(5.0);
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    QVERIFY(s.time.isFollowing());
    const telemetry::GroupId group = *s.source.store->findGroup("B1");
    for (int i = 301; i <= 40 * 60; ++i) s.source.append(group, i / 60.0, 1, 77.0);
    QTRY_COMPARE(s.time.range().end, 40.0);
    QCOMPARE(s.time.span(), SourceKind::Simulate.window);
    QTRY_COMPARE(chart->legend()->entries().value(0).value, QStringLiteral("77.00"));
    // A window by hand; following goes on.
    s.time.setWindow(5.0);
    QCOMPARE(s.time.range().begin, 35.0);
  }

  /// Numbers of the axis leave nothing behind where they were.
  void numbersOfOldLimitsAreGone() {
    Shown s(5.0);
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    QVERIFY(QTest::qWaitForWindowExposed(s.dock.get()));
    const telemetry::GroupId group = *s.source.store->findGroup("B1");
    const auto isClean = [&] {
      QWidget* at = chart->surface();
      const int wide = static_cast<int>(chart->timeAxis().left) - 2;
      const QRect place(at->mapTo(s.dock.get(), QPoint()), QSize(wide, at->height()));
      const QImage screen = s.dock->screen()->grabWindow(s.dock->winId()).toImage();
      const QImage fresh = at->grab(QRect(QPoint(), place.size())).toImage();
      return screen.copy(place).convertToFormat(QImage::Format_RGB32) ==
             fresh.convertToFormat(QImage::Format_RGB32);
    };
    QTRY_VERIFY(isClean());
    for (int i = 1; i < 8; ++i) {
      s.source.append(group, 5.0 + i, 1, 100.0 + 37.0 * i);
      const ValueScale before = chart->valueScale();
      QTRY_VERIFY(chart->valueScale().limits.high != before.limits.high ||
                  s.time.data()->end == 5.0 + i);
      QTRY_VERIFY2(isClean(), qPrintable(QString::number(i)));
    }
  }

  void theWheelZoomsAtTheCursor() {
    Shown s;
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    s.time.setRange({0.0, 20.0});
    const TimeAxis axis = chart->timeAxis();
    const QPoint at(int(axis.left + 0.25 * axis.width), 30);
    const double anchor = axis.time(at.x());
    wheel(chart->surface(), at, 1);
    QCOMPARE(s.time.span(), 16.0);
    QVERIFY(std::abs(chart->timeAxis().time(at.x()) - anchor) < 1e-9);
    QVERIFY(!s.time.isFollowing());
    // With Ctrl the values, around the pointer.
    s.dock->grab();
    const ValueScale before = chart->valueScale();
    const double value = before.toValue(at.y());
    wheel(chart->surface(), at, 1, Qt::ControlModifier);
    const ValueScale after = chart->valueScale();
    QCOMPARE(s.time.span(), 16.0);
    QVERIFY(std::abs(after.toValue(at.y()) - value) < 1e-9);
    QVERIFY(after.limits.high - after.limits.low < before.limits.high - before.limits.low);
    QVERIFY(!chart->spec().autoValues);
    // While following, the newest moment stays at the right.
    s.time.setFollowing(true);
    wheel(chart->surface(), at, -1);
    QCOMPARE(s.time.range().end, 30.0);
    QVERIFY(s.time.isFollowing());
  }

  void noTimeIsBeforeTheBeginning() {
    Shown s;
    s.dropped({"B1/DIST"});
    s.time.setRange({-30.0, 30.0});
    const auto* ruler = s.dock->currentPage()->findChild<TimeRuler*>();
    const auto labels = ruler->labels();
    QVERIFY(labels.size() >= 3);
    for (const AxisTick& tick : labels) QVERIFY2(tick.time >= 0.0, qPrintable(tick.label));
    // Times of day go on.
    s.dock->feed()->setClock(QDateTime(QDate(2026, 7, 1), QTime(14, 11, 0)));
    QVERIFY(ruler->labels().front().time < 0.0);
  }

  void draggingMovesAndABoxZooms() {
    Shown s;
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    s.time.setRange({5.0, 15.0});
    const TimeAxis axis = chart->timeAxis();
    const double perPixel = 10.0 / axis.width;
    drag(chart->surface(), {400, 40}, {300, 40});
    QVERIFY(std::abs(s.time.range().begin - (5.0 + 100 * perPixel)) < 1e-6);
    QVERIFY(std::abs(s.time.span() - 10.0) < 1e-9);
    s.dock->grab();
    const TimeAxis now = chart->timeAxis();
    const ValueScale values = chart->valueScale();
    drag(chart->surface(), {200, 30}, {500, 90}, Qt::ShiftModifier);
    QVERIFY(std::abs(s.time.range().begin - now.time(200)) < 1e-6);
    QVERIFY(std::abs(s.time.range().end - now.time(500)) < 1e-6);
    QVERIFY(std::abs(chart->spec().values.low - values.toValue(90)) < 1e-6);
    QVERIFY(std::abs(chart->spec().values.high - values.toValue(30)) < 1e-6);
    // A double click shows everything again.
    QTest::mouseDClick(chart->surface(), Qt::LeftButton, {}, {300, 40});
    QCOMPARE(s.time.range().begin, 0.0);
    QCOMPARE(s.time.range().end, 30.0);
    QVERIFY(chart->spec().autoValues);
  }

  void theLegendShowsTheValueAtTheCursor() {
    Shown s;
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    s.time.setRange({0.0, 10.0});
    const TimeAxis axis = chart->timeAxis();
    const int x = int(axis.pixel(4.0));
    QTest::mouseMove(chart->surface(), {x, 40});
    QMouseEvent move(QEvent::MouseMove, QPoint(x, 40), chart->surface()->mapToGlobal(QPoint(x, 40)),
                     Qt::NoButton, Qt::NoButton, {});
    QApplication::sendEvent(chart->surface(), &move);
    QVERIFY(s.time.cursor().has_value());
    const double tick = std::floor(*s.time.cursor() * 60.0 + 1e-9) / 60.0;
    QCOMPARE(chart->legend()->entries()[0].value, valueText(PlotSource::distanceAt(tick)));
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(chart->surface(), &leave);
    QCOMPARE(chart->legend()->entries()[0].value, valueText(PlotSource::distanceAt(30.0)));
  }

  void nanAndGapsBreakTheLine() {
    PlotSource source;
    const telemetry::GroupId group = source.addRobot("B1");
    for (int i = 0; i < 60; ++i) source.append(group, i / 60.0, 0, i == 30 ? std::nan("") : 1.0);
    for (int i = 0; i < 60; ++i) source.append(group, 30.0 + i / 60.0, 0, 1.0);
    const ColumnView view{source.store->view(group), 1};
    for (const int columns : {2000, 20}) {  // samples one by one; in columns
      const CurveTrace trace = traceOf(view, {0.0, columns == 20 ? 60.0 : 32.0}, columns);
      const auto lines = polylines(trace, {{0.0, 32.0}, 0, 800}, {{0.0, 2.0}, 0, 100}, false);
      QCOMPARE(lines.size(), std::size_t(columns == 20 ? 2 : 3));
    }
  }

  void aBallOutOfViewIsAGap() {
    PlotBench bench;
    telemetry::GroupInfo info;
    info.name = "B1";
    info.columns.push_back({"VISION_LOST", telemetry::ColumnType::Int32, "", "", {}, {}});
    info.columns.push_back({"VISION_BALL_DIST", telemetry::ColumnType::Float32, "cm", "", {}, {}});
    info.columns[1].lost = {{"VISION_LOST", 1}};
    const auto group = bench.source.store->addGroup(info);
    for (int i = 0; i <= 600; ++i) {  // lost from 4 s to 6 s and again from 9 s on
      const double time = i / 60.0;
      const bool lost = (time >= 4.0 && time < 6.0) || time >= 9.0;
      const std::uint32_t words[] = {lost, std::bit_cast<std::uint32_t>(100.0F + float(i % 7))};
      bench.source.store->append(group, {time, words, {}});
    }
    PlotsDock dock(bench.context(), nullptr);
    dock.resize(1000, 300);
    dock.show();
    dock.plotVariables({"B1/VISION_BALL_DIST"});
    const auto* chart = qobject_cast<ChartPane*>(dock.currentPage()->panes().value(0));
    const auto value = [&] { return chart->legend()->entries().value(0).value; };
    QTRY_COMPARE(value(), QStringLiteral("–"));
    bench.source.goTo(10.0);
    bench.sources.seek(3.0);
    QTRY_VERIFY(value() != QStringLiteral("–"));
    bench.sources.seek(5.0);
    QTRY_COMPARE(value(), QStringLiteral("–"));
    for (const int columns : {2000, 100}) {  // samples one by one; in columns
      const telemetry::TimeRange range{0.0, 10.0};
      const CurveTrace trace = traceOf(chart->curves()[0].view(), range, columns);
      QCOMPARE(trace.exact, columns == 2000);
      const auto lines = polylines(trace, {range, 0, 2000}, {{0.0, 200.0}, 0, 100}, false);
      QCOMPARE(lines.size(), std::size_t(2));
    }
    // The table of the marks says neither the old value nor "NaN".
    bench.time.shown()->setMark(TimeMark::A, 3.0);
    bench.time.shown()->setMark(TimeMark::B, 5.0);
    MarksModel model;
    model.setRows({marksRow(chart->curves()[0], 3.0, 5.0)});
    QCOMPARE(model.index(0, MarksModel::AtB).data().toString(), QStringLiteral("–"));
    QCOMPARE(model.index(0, MarksModel::Delta).data().toString(), QStringLiteral("–"));
    QVERIFY(model.index(0, MarksModel::Mean).data().toString() != QStringLiteral("–"));
  }

  void anOldValueIsNotShown() {
    Shown s(1.0);
    auto* chart = qobject_cast<ChartPane*>(s.dropped({"B1/DIST"}));
    const telemetry::GroupId other = s.source.addRobot("B2");
    s.source.append(other, 10.0, 1, 1.0);
    QTRY_VERIFY(chart->legend()->entries().value(0).value != QStringLiteral("–"));
    s.source.append(other, 12.0, 1, 1.0);
    QTRY_COMPARE(chart->legend()->entries().value(0).value, QStringLiteral("–"));
  }

  void aTimeOfTheMomentCoversNoNumber() {
    Shown s;
    s.dropped({"B1/DIST"});
    s.time.setRange({10.0, 20.0});
    const auto* ruler = s.dock->findChild<TimeRuler*>();
    const auto all = ruler->labels();
    QVERIFY(all.size() > 3);
    s.source.goTo(30.0);
    s.sources.seek(all[1].time + 0.05);
    const auto rest = ruler->labels();
    QCOMPARE(rest.size(), all.size() - 1);
    QCOMPARE(rest[0].time, all[0].time);
    QCOMPARE(rest[1].time, all[2].time);
  }

  void anEnvelopeIsABand() {
    using namespace pitchboard::telemetry;
    /// Two buckets of 256 rows: 10 to 30, then 50 to 60.
    class Coarse : public SeriesPages {
     public:
      std::shared_ptr<const GroupSummary> summary(GroupId, bool) override {
        auto all = std::make_shared<GroupSummary>();
        SummaryPart part;
        part.begin = {0.0, 10.0};
        part.end = {9.9, 19.9};
        part.rows = {256, 256};
        part.columns = {{{10.0F, 50.0F}, {30.0F, 60.0F}, {20.0F, 55.0F}}};
        all->parts.push_back(part);
        return all;
      }
      std::optional<Stretch> held(GroupId, std::optional<TimeRange>) override { return {}; }
      void want(TimeRange) override {}
      std::optional<SeriesStatistics> statistics(GroupId, std::uint32_t, TimeRange) override {
        return {};
      }
      bool isReading(TimeRange) override { return reading; }
      std::uint64_t revision() override { return 1; }
      void setListener(std::function<void()>) override {}
      TimeRange range() override { return {0.0, 19.9}; }
      std::size_t bytes() override { return 0; }
      bool reading = true;
    };
    const auto pages = std::make_shared<Coarse>();
    SeriesStore store;
    const auto group = store.addGroup({"B1", {{"X", ColumnType::Float64, "", "", {}, {}}}, {}});
    const ColumnView view{pagedView(store.view(group), group, pages), 0};
    const TimeRange range{0.0, 20.0};
    const CurveTrace trace = traceOf(view, range, 200);
    QVERIFY(!trace.exact && trace.coarse && trace.reading);
    pages->reading = false;
    QVERIFY(!traceOf(view, range, 200).reading);
    QImage image(200, 100, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::white);
    QPainter painter(&image);
    const TimeAxis time{range, 0.0, 200.0};
    TraceLook look;
    look.color = Qt::black;
    paintTrace(painter, trace, polylines(trace, time, {{0.0, 100.0}, 0.0, 100.0}, false), time,
               look);
    painter.end();
    const auto grey = [&image](int x, int y) { return qGray(image.pixel(x, y)); };
    // All of it between 10 and 30, paler than a line, and nothing beside it.
    QVERIFY(grey(50, 80) > 100 && grey(50, 80) < 240);
    QCOMPARE(grey(50, 75), grey(50, 85));
    QCOMPARE(grey(50, 60), 255);
    QVERIFY(grey(150, 45) < 240 && grey(150, 80) == 255);
    // A mean of it would be a guess: it is said that it is being read.
    QVERIFY(view.group->statistics(0, range).reading);
  }

  void slowSamplesAreDotsAndHeld() {
    PlotSource source;
    telemetry::GroupInfo info;
    info.name = "B1 link";
    info.columns.push_back({"RATE", telemetry::ColumnType::Float64, "1/s", "", {}, {}});
    const auto group = source.store->addGroup(info);
    for (int i = 0; i < 30; ++i) {
      const double value = i % 2 == 0 ? 2.0 : 8.0;
      source.store->append(group, {i * 1.0, {}, std::span(&value, 1)});
    }
    const telemetry::TimeRange range{0.0, 20.0};
    const TimeAxis time{range, 0.0, 400.0};
    const CurveTrace trace = traceOf({source.store->view(group), 0}, range, 400);
    QVERIFY(trace.exact && trace.held);
    TraceLook look;
    look.color = Qt::black;
    QImage image(400, 100, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::white);
    QPainter painter(&image);
    const ValueScale values{{0.0, 10.0}, 0.0, 100.0};
    paintTrace(painter, trace, polylines(trace, time, values, false), time, look);
    painter.end();
    const auto dark = [&image](double x, double y) {
      return qGray(image.pixel(qRound(x), qRound(y)));
    };
    // A dot at a sample of 2 at 4 s; the line stays there until 5 s, paler, and does not slope.
    QVERIFY(dark(80, 80) < 40);
    QVERIFY(dark(80, 78) < 128 && dark(80, 82) < 160);
    QVERIFY(dark(90, 80) > 60 && dark(90, 80) < 200);
    QVERIFY(dark(90, 74) == 255 && dark(90, 50) == 255);
    // Sixty a second, or words of a code, are drawn as before.
    const auto fast = source.fill("B1", 3.0);
    QVERIFY(!traceOf({source.store->view(fast), 1}, {0.0, 3.0}, 400).held);
    // The newest value holds until now.
    const CurveTrace newest = traceOf({source.store->view(group), 0}, {10.0, 40.0}, 400, 31.5);
    QCOMPARE(newest.heldUntil, 31.5);
    QCOMPARE(polylines(newest, {{10.0, 40.0}, 0.0, 300.0}, values, false).back().last().x(), 215.0);
  }

  void aThinnedCurveKeepsItsExtremes() {
    PlotSource source;
    const telemetry::GroupId group = source.addRobot("B1");
    constexpr int rows = 200'000;
    for (int i = 0; i < rows; ++i) {
      source.append(group, i * 0.001, 0, i == 123'456 ? 500.0 : i == 7'777 ? -300.0 : 1.0);
    }
    const CurveTrace trace = traceOf({source.store->view(group), 1}, {0.0, rows * 0.001}, 1000);
    QVERIFY(!trace.exact);
    QVERIFY(trace.columns.size() <= 1003);
    QCOMPARE(trace.low, -300.0);
    QCOMPARE(trace.high, 500.0);
    std::size_t points = 0;
    for (const QPolygonF& line :
         polylines(trace, {{0.0, 200.0}, 0, 1000}, {{-300, 500}, 0, 100}, false)) {
      points += std::size_t(line.size());
    }
    QVERIFY(points <= 2 * trace.columns.size());
  }

  void codesAreLanesWithLabels() {
    Shown s(9.0);
    auto* lane = qobject_cast<LanePane*>(s.dropped({"B1/ACTION"}));
    QVERIFY(lane);
    s.time.setRange({0.0, 9.0});
    QTRY_COMPARE(lane->stretches(0).size(), std::size_t(9));
    for (int i = 0; i < 9; ++i) {
      const LaneStretch& stretch = lane->stretches(0)[std::size_t(i)];
      QVERIFY(std::abs(stretch.begin - i) < 0.02);
      QCOMPARE(stretch.value, double(i % 3));
      QVERIFY(!stretch.mixed);
    }
    QCOMPARE(lane->curves()[0].codeText(1), QString::fromStdString(actionLabel(1)));
    QCOMPARE(lane->curves()[0].codeText(99), QStringLiteral("99"));
    // Far out the changes are too close to be told apart, which is said.
    s.time.setRange({-5000.0, 5000.0});
    QTRY_VERIFY(!lane->stretches(0).empty() && lane->stretches(0).size() < 9);
  }

  void variablesThatAreNotThereYetAreWaitedFor() {
    Shown s(0.0);
    s.page()->addVariables({"B2/DIST"});
    auto* chart = qobject_cast<ChartPane*>(s.pane());
    QVERIFY(chart->curves()[0].isWaiting());
    QCOMPARE(chart->legend()->entries()[0].text, QStringLiteral("waiting for B2/DIST"));
    QVERIFY(chart->legend()->entries()[0].muted);
    s.source.fill("B2", 5.0);
    QTRY_VERIFY(!chart->curves()[0].isWaiting());
    QTRY_VERIFY(!chart->legend()->entries()[0].muted);
    // Another match: the curve waits again, and is found again.
    s.source.restart();
    QTRY_VERIFY(chart->curves()[0].isWaiting());
    s.source.fill("B2", 2.0);
    QTRY_COMPARE(chart->curves()[0].valueAt({}), std::optional(PlotSource::distanceAt(2.0)));
  }

  void theLayoutIsKept() {
    PlotBench bench;
    bench.source.fill("B1", 3.0);
    PlotLayout before;
    {
      PlotsDock dock(bench.context(), nullptr);
      dock.resize(900, 400);
      dock.show();
      dock.currentPage()->addVariables({"B1/DIST", "B1/ACTION", "B9/NEVER"});
      dock.currentPage()->setName("approach");
      dock.addPage({"second", {}});
      before = dock.layoutSpec();
    }
    PlotsDock dock(bench.context(), nullptr);
    const PlotLayout after = dock.layoutSpec();
    QCOMPARE(after.pages.size(), 2);
    QCOMPARE(after.pages[0].name, QStringLiteral("approach"));
    QCOMPARE(after.pages[0].panes.size(), before.pages[0].panes.size());
    QCOMPARE(after.pages[0].panes[0].curves, before.pages[0].panes[0].curves);
    // A layout that cannot be read does not keep the plots from opening.
    bench.settings.setValue("plots/layout", "{\"pitchboardPlots\": 99");
    PlotsDock fresh(bench.context(), nullptr);
    QCOMPARE(fresh.pages().size(), 1);
  }

  void aFilledDockIsDrawnInBothThemes_data() {
    QTest::addColumn<bool>("dark");
    QTest::addColumn<QSize>("size");
    QTest::addColumn<double>("ratio");
    QTest::newRow("dark-1280") << true << QSize(1280, 260) << 1.0;
    QTest::newRow("light-1280") << false << QSize(1280, 260) << 1.0;
    QTest::newRow("dark-1920") << true << QSize(1920, 360) << 1.0;
    QTest::newRow("light-200") << false << QSize(1280, 260) << 2.0;
  }
  /// With PITCHBOARD_PICTURES=FOLDER the pictures are kept, to be looked at.
  void aFilledDockIsDrawnInBothThemes() {
    QFETCH(bool, dark);
    QFETCH(QSize, size);
    QFETCH(double, ratio);
    setTheme(*qApp, dark ? ThemeChoice::Dark : ThemeChoice::Light);
    const auto back = qScopeGuard([] { setTheme(*qApp, ThemeChoice::Dark); });
    Shown s(30.0);
    const telemetry::GroupId second = s.source.addRobot("B2");
    for (int i = 0; i <= 30 * 60; ++i) {
      const double time = i / 60.0;
      const bool lost = time > 20.2 && time < 22.3;
      s.source.append(
          second, time, 0,
          lost ? std::nan("") : 210 + 30 * std::tanh((time - 23) / 2) + 2 * std::sin(i * 1.3),
          85.0 * time + 6 * std::sin(time * 3));
    }
    s.dock->resize(size);
    PageSpec page{"approach", {}};
    PaneSpec chart, heading, lane;
    chart.curves << variableCurve("B1/DIST") << variableCurve("B2/DIST");
    heading.curves << variableCurve("B1/ANGLE") << variableCurve("B2/ANGLE")
                   << variableCurve("R7/NOT_THERE_YET");
    for (PaneSpec* pane : {&chart, &heading}) {
      for (int i = 0; i < pane->curves.size(); ++i) {
        pane->curves[i].colorNumber = i + (pane == &heading ? 2 : 0);
      }
    }
    heading.curves[0].title = "heading true B1";
    heading.curves[1].title = "heading believed B1";
    lane.kind = PaneKind::Lane;
    lane.curves << variableCurve("B1/ACTION");
    page.panes << chart << heading << lane;
    s.dock->setLayoutSpec({{page, {"localization", {}}}, 0});
    s.time.shown()->setMark(TimeMark::A, 21.0);
    s.time.shown()->setMark(TimeMark::B, 27.0);
    QImage image;
    // Whether each plot has a pixel of its curves' colours, below the legend.
    const auto curvesAreSeen = [&] {
      QPixmap picture(size * ratio);
      picture.setDevicePixelRatio(ratio);
      s.dock->render(&picture);
      image = picture.toImage().convertToFormat(QImage::Format_RGB32);
      bool all = true;
      for (int pane = 0; pane < 2; ++pane) {
        const QWidget* surface = s.pane(pane)->surface();
        const QRect where(surface->mapTo(s.dock.get(), QPoint()) * ratio, surface->size() * ratio);
        for (const int number : {2 * pane, 2 * pane + 1}) {
          const QColor wanted = curveColor(number);
          bool found = false;
          for (int y = where.top(); y < where.bottom() && !found; ++y) {
            for (int x = where.left(); x < where.right() && !found; ++x) {
              const QColor is = image.pixelColor(x, y);
              found = std::abs(is.red() - wanted.red()) + std::abs(is.green() - wanted.green()) +
                          std::abs(is.blue() - wanted.blue()) <
                      60;
            }
          }
          all = all && found;
        }
      }
      return all;
    };
    QTRY_VERIFY(curvesAreSeen());
    // The lane leaves no room unused below it.
    const PlotPane* last = s.page()->panes().last();
    const int below = s.page()->picture()->height() -
                      last->mapTo(s.page()->picture(), QPoint(0, last->height())).y();
    QVERIFY2(below < 30, qPrintable(QString::number(below)));
    const QString folder = qEnvironmentVariable("PITCHBOARD_PICTURES");
    if (!folder.isEmpty()) {
      QVERIFY(image.save(QStringLiteral("%1/plots-%2.png").arg(folder, QTest::currentDataTag())));
    }
  }
};

PITCHBOARD_GUI_TEST(TestPlots)

}  // namespace tst_plots

#include "tst_plots.moc"
