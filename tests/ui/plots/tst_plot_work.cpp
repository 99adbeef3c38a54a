// SPDX-License-Identifier: GPL-3.0-or-later
// What is done with plots over a working day: layouts, undo, second axis, many curves, pictures for
// others. Values are computed here.
#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QSplitter>
#include <QTableView>
#include <QToolButton>
#include <QUndoStack>
#include <QtTest>
#include <set>

#include <ui/base/notice_bar.h>
#include <ui/base/theme.h>
#include <ui/plots/plot_menus.h>

#include "../support/menu_entry.h"
#include "../support/mouse_wheel.h"
#include "chart_pane.h"
#include "curve_dialog.h"
#include "marks_model.h"
#include "marks_panel.h"
#include "plot_export.h"
#include "plot_feed.h"
#include "plot_page.h"
#include "plot_rig.h"
#include "plot_source.h"
#include "value_chart.h"
#include "xy_pane.h"

namespace tst_plot_work {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;

class TestPlotWork : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  /// Curves were drawn again with the next frame only.
  void curvesWakeUpByTheirRows() {
    PlotBench bench;
    PlotFeed feed(&bench.sources, &bench.time);
    feed.setRunning(true);
    QTRY_VERIFY(Beat::display().isIdle());
    QSignalSpy refreshed(&feed, &PlotFeed::refreshed);
    bench.source.fill("B1", 1.0);
    emit bench.source.rowsAppended();
    QVERIFY(!Beat::display().isIdle());
    QTRY_VERIFY(!refreshed.isEmpty());
    QVERIFY(feed.find(QStringLiteral("B1/DIST")));
  }

  void aNarrowLegendKeepsItsValue() {
    const auto picture = [](const char* value) {
      LegendBar bar;
      bar.resize(160, 16);
      bar.setEdges(0, 0);
      LegendEntry entry;
      entry.text = QStringLiteral("B1 VISION_BALL_DIST_FILTERED [cm]");
      entry.value = QString::fromLatin1(value);
      entry.color = Qt::red;
      bar.setEntries({entry});
      return bar.grab().toImage();
    };
    QVERIFY(picture("123.45") != picture("123.46"));
  }

  void everythingIsUndone() {
    Bench b;
    QUndoStack* undo = b.dock->undoStack();
    QVERIFY(!undo->canUndo());
    b.dock->plotVariables({QStringLiteral("B1/DIST")});
    b.dock->plotVariables({QStringLiteral("B2/DIST")});
    b.dock->plotVariables({QStringLiteral("B1/ACTION")});
    const PlotLayout full = b.dock->layoutSpec();
    b.dock->currentPage()->removeAll();
    QVERIFY(b.dock->currentPage()->panes().isEmpty());
    undo->undo();
    QCOMPARE(b.dock->layoutSpec().pages[0].panes.size(), full.pages[0].panes.size());
    QCOMPARE(b.dock->layoutSpec().pages[0].panes[0].curves, full.pages[0].panes[0].curves);
    undo->undo();
    undo->undo();
    QCOMPARE(b.dock->currentPage()->panes().size(), 1);
    QCOMPARE(namesOf(b.dock->currentPage()->panes()[0]), QStringList(QStringLiteral("DIST B1")));
    undo->undo();
    QVERIFY(b.dock->currentPage()->panes().isEmpty());
    QVERIFY(!undo->canUndo());
    while (undo->canRedo()) undo->redo();
    QVERIFY(b.dock->currentPage()->panes().isEmpty());
    undo->undo();
    QCOMPARE(b.dock->currentPage()->panes().size(), 2);
  }

  void aSecondAxisHasLimitsOfItsOwn() {
    Bench b;
    CurveSpec angle = variableCurve(QStringLiteral("B1/ANGLE"));
    angle.side = CurveSpec::Side::Left;
    auto* chart = qobject_cast<ChartPane*>(b.show(variableCurve(QStringLiteral("B1/DIST"))));
    chart->addCurve(angle);
    b.time.setRange({0.0, 10.0});
    QTRY_VERIFY(chart->valueScale().limits.high >= 900.0);
    const int narrow = chart->wantedRight();
    angle = chart->description(1);
    angle.side = CurveSpec::Side::Right;
    chart->setCurve(1, angle);
    QVERIFY(chart->valueScale().limits.high < 300.0);
    QVERIFY(chart->rightScale().limits.high >= 900.0);
    QVERIFY(chart->wantedRight() > narrow);
    // It comes back from a file.
    const QByteArray text = QJsonDocument(toJson(b.dock->layoutSpec())).toJson();
    const auto read = layoutFromText({text.data(), std::size_t(text.size())}, "test");
    QVERIFY(read);
    QCOMPARE(read->pages[0].panes[0].curves[1].side, CurveSpec::Side::Right);
    QCOMPARE(read->pages[0].panes[0].curves[0].side, CurveSpec::Side::ByUnit);
  }

  void theSecondAxisIsSetByHandAndKept() {
    Bench b;
    auto* chart = qobject_cast<ChartPane*>(b.show(variableCurve(QStringLiteral("B1/DIST"))));
    b.time.setRange({0.0, 10.0});
    // Without a curve at the right nothing is asked about it.
    AxesDialog plain(chart->spec(), {}, {}, nullptr);
    QVERIFY(!plain.findChild<QLineEdit*>(QStringLiteral("rightlowLimit")));
    CurveSpec angle = variableCurve(QStringLiteral("B1/ANGLE"));
    angle.side = CurveSpec::Side::Right;
    chart->addCurve(angle);
    const ValueLimits left = chart->valueScale().limits;
    AxesDialog dialog(chart->spec(), left, chart->rightScale().limits, nullptr);
    const auto type = [&dialog](const char* box, const QString& number) {
      dialog.findChild<QLineEdit*>(QLatin1String(box))->setText(number);
    };
    dialog.findChild<QCheckBox*>(QStringLiteral("rightfixedLimits"))->setChecked(true);
    type("rightlowLimit", QStringLiteral("-3,5"));
    type("righthighLimit", QStringLiteral("-4"));
    QVERIFY(!dialog.findChild<QLabel*>(QStringLiteral("problem"))->text().isEmpty());
    type("righthighLimit", QStringLiteral("12"));
    PaneSpec set = dialog.pane();
    set.rightTitle = QStringLiteral("degrees");
    const int narrow = chart->wantedRight();
    chart->setOptions(set);
    QCOMPARE(chart->rightScale().limits, (ValueLimits{-3.5, 12.0}));
    QCOMPARE(chart->valueScale().limits, left);
    QVERIFY(chart->wantedRight() > narrow);
    const QByteArray text = QJsonDocument(toJson(b.dock->layoutSpec())).toJson();
    const auto read = layoutFromText({text.data(), std::size_t(text.size())}, "test");
    QVERIFY(read);
    QVERIFY(!read->pages[0].panes[0].autoRight && read->pages[0].panes[0].autoValues);
    QCOMPARE(read->pages[0].panes[0].right, (ValueLimits{-3.5, 12.0}));
    QCOMPARE(read->pages[0].panes[0].rightTitle, QStringLiteral("degrees"));
  }

  void everythingIsRemovedByTheMenu() {
    Bench b;
    b.dock->plotVariables({QStringLiteral("B1/DIST")});
    b.dock->plotVariables({QStringLiteral("B1/ACTION")});
    QCOMPARE(b.dock->currentPage()->panes().size(), 2);
    const std::unique_ptr<QMenu> menu(makePlotsMenu(b.dock.get()));
    menu_entry::called(menu->actions(), QStringLiteral("Remove all plots of this tab"))->trigger();
    QVERIFY(b.dock->currentPage()->panes().isEmpty());
    b.dock->undoStack()->undo();
    QCOMPARE(b.dock->currentPage()->panes().size(), 2);
  }

  void eightCurvesAreReportedApart() {
    for (const ThemeChoice choice : {ThemeChoice::Dark, ThemeChoice::Light}) {
      setTheme(*qApp, choice);
      const auto back = qScopeGuard([] { setTheme(*qApp, ThemeChoice::Dark); });
      for (int a = 0; a < curveColors; ++a) {
        for (int b = a + 1; b < curveColors; ++b) {
          // By hue, or one of them is grey.
          const QColor x = curveColor(a), y = curveColor(b);
          const int apart = std::abs((x.hslHue() - y.hslHue() + 540) % 360 - 180);
          const bool hue = apart >= 14, grey = std::abs(x.hslSaturation() - y.hslSaturation()) > 60;
          QVERIFY2(hue || grey, qPrintable(QStringLiteral("%1 and %2").arg(a + 1).arg(b + 1)));
        }
      }
    }
  }

  void sixteenCurvesAreReportedApart() {
    Bench b;
    PlotPane* pane = b.show(variableCurve(QStringLiteral("B1/DIST")));
    for (int i = 1; i < 32; ++i) {
      pane->addCurve(expression(QStringLiteral("B1.DIST + %1").arg(i)));
    }
    std::set<std::pair<QRgb, int>> looks;
    for (const LegendEntry& entry : pane->legend()->entries()) {
      looks.emplace(entry.color.rgb(), entry.dash);
    }
    QCOMPARE(looks.size(), std::size_t(32));
    // Dashes leave gaps, and scroll with the curve.
    const auto picture = [](int dash, double shift) {
      QImage image(200, 20, QImage::Format_ARGB32_Premultiplied);
      image.fill(Qt::white);
      QPainter painter(&image);
      CurveTrace trace;
      for (int i = 0; i <= 20; ++i) trace.samples.push_back({double(i), 10.0});
      const TimeAxis time{{0.0 + shift, 20.0 + shift}, 0.0, 200.0};
      TraceLook look;
      look.color = Qt::black;
      look.dash = dash;
      paintTrace(painter, trace, polylines(trace, time, {{0.0, 20.0}, 0.0, 20.0}, false), time,
                 look);
      return image;
    };
    const auto dark = [](const QImage& image) {
      int count = 0;
      for (int x = 20; x < 180; ++x) count += qGray(image.pixel(x, 10)) < 128 ? 1 : 0;
      return count;
    };
    QCOMPARE(dark(picture(0, 0.0)), 160);
    for (const int dash : {1, 2, 3}) {
      QVERIFY2(dark(picture(dash, 0.0)) > 60 && dark(picture(dash, 0.0)) < 130,
               qPrintable(QString::number(dash)));
    }
    const QImage here = picture(1, 0.0), later = picture(1, 3.0);  // 30 px to the left
    QCOMPARE(later.copy(30, 0, 100, 20), here.copy(60, 0, 100, 20));
  }

  void manyPlotsScroll() {
    Bench b;
    const QSize before = b.dock->size();
    PaneSpec lane;
    lane.kind = PaneKind::Lane;
    lane.curves << variableCurve(QStringLiteral("B1/ACTION"));
    for (int i = 0; i < 24; ++i) b.dock->currentPage()->insertPane(i, lane);
    QVERIFY(b.dock->minimumSizeHint().height() < 200);
    QCOMPARE(b.dock->size(), before);
    auto* bar = b.dock->findChild<QScrollArea*>()->verticalScrollBar();
    QTRY_VERIFY(bar->maximum() > 300);
    // The wheel over the numbers beside the axis.
    QWidget* surface = b.dock->currentPage()->panes()[0]->surface();
    const telemetry::TimeRange range = b.time.range();
    turnWheel(surface, {4, 10}, -240);
    QTRY_VERIFY(bar->value() > 0);
    QCOMPARE(b.time.range(), range);
  }

  void theTableOfMarksShowsAllItsColumns() {
    Bench b;
    b.dock->resize(1404, 224);
    b.dock->plotVariables({QStringLiteral("B1/DIST"), QStringLiteral("B1/ACTION")});
    b.time.setRange({0.0, 10.0});
    b.time.showMarks(true);
    auto* table = b.dock->currentPage()->marksPanel()->findChild<QTableView*>();
    QTRY_VERIFY(table->isVisible());
    QTRY_VERIFY(!table->horizontalScrollBar()->isVisible());
    QCOMPARE(table->columnAt(table->viewport()->width() - 2), int(MarksModel::columns) - 1);
    QVERIFY(table->columnWidth(0) >= 100);
    const QFontMetrics metrics(themeFont(TypeRole::Secondary));
    for (const int column : {MarksModel::Name, MarksModel::AtA, MarksModel::AtB}) {
      for (int row = 0; row < 2; ++row) {
        const QString text = table->model()->index(row, column).data().toString();
        QVERIFY2(metrics.horizontalAdvance(text) + 10 <= table->columnWidth(column),
                 qPrintable(text));
      }
    }
    // Beside it a chart that can be read, and a whole lane.
    PlotPane* chart = b.dock->currentPage()->panes()[0];
    QTRY_VERIFY2(chart->surface()->height() >= 64, qPrintable(QString::number(chart->height())));
    QVERIFY(chart->surface()->width() > 500);
  }

  void picturesAreCleanForOthers() {
    Bench b;
    PlotPane* pane = b.show(variableCurve(QStringLiteral("B1/DIST")));
    b.time.setRange({0.0, 10.0});
    const QImage clean = plotPicture(*b.dock->currentPage(), 1.0);
    const QPoint at(qRound(pane->timeAxis().pixel(5.0)), 40);
    QMouseEvent move(QEvent::MouseMove, at, pane->surface()->mapToGlobal(at), Qt::NoButton,
                     Qt::NoButton, {});
    QApplication::sendEvent(pane->surface(), &move);
    QVERIFY(b.time.cursor());
    // Below the legend, which has the value at the pointer, nothing is another.
    const QImage pointed = plotPicture(*b.dock->currentPage(), 1.0);
    const int top = pane->surface()->mapTo(b.dock->currentPage()->picture(), QPoint()).y();
    QCOMPARE(pointed.copy(0, top, pointed.width(), pointed.height()),
             clean.copy(0, top, clean.width(), clean.height()));
    const QString path = b.folder.filePath(QStringLiteral("plots.svg"));
    QVERIFY(savePlotPicture(plotSvg(*b.dock->currentPage()), path));
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString svg = QString::fromUtf8(file.readAll());
    QVERIFY(svg.contains(QStringLiteral("font-family=")));
    QVERIFY(!svg.contains(QStringLiteral("\"Sans Serif")));
    QCOMPARE(svg.count(QStringLiteral("font-family=")), svg.count(QStringLiteral("sans-serif\"")));
  }

  void picturesHaveNoHandles() {
    Bench b;
    b.show(variableCurve(QStringLiteral("B1/DIST")));
    b.show(variableCurve(QStringLiteral("B1/ANGLE")));
    b.time.setRange({0.0, 10.0});
    QCoreApplication::processEvents();
    QWidget* const shown = b.dock->currentPage()->picture();
    const QSplitter* panes = nullptr;
    for (const QSplitter* splitter : shown->findChildren<QSplitter*>()) {
      if (splitter->orientation() == Qt::Vertical) panes = splitter;
    }
    QVERIFY(panes && panes->count() == 2);
    const QRect handle(panes->handle(1)->mapTo(shown, QPoint()), panes->handle(1)->size());
    const auto colors = [&handle](const QImage& image) {
      std::set<QRgb> all;
      for (int y = handle.top(); y <= handle.bottom(); ++y) {
        for (int x = handle.left(); x <= handle.right(); ++x) all.insert(image.pixel(x, y));
      }
      return all.size();
    };
    QVERIFY(colors(shown->grab().toImage()) > 1);  // the dots to be dragged
    QCOMPARE(colors(plotPicture(*b.dock->currentPage(), 1.0)), std::size_t(1));
    QCOMPARE(panes->handle(1)->isVisible(), true);
  }

  void aDropOfManyIsOneStep() {
    Bench b;
    QUndoStack* undo = b.dock->undoStack();
    dropOn(b.dock->currentPage(), {"B1/DIST", "B2/DIST", "B1/ANGLE", "B1/ACTION"},
           b.dock->currentPage()->rect().center());
    QCOMPARE(b.dock->currentPage()->panes().size(), 2);
    QCOMPARE(undo->count(), 1);
    undo->undo();
    QVERIFY(b.dock->currentPage()->panes().isEmpty());
    undo->redo();
    QCOMPARE(b.dock->currentPage()->panes().size(), 2);
    b.dock->plotVariables({"B2/ANGLE", "B2/ACTION"});
    QCOMPARE(undo->count(), 2);
  }

  void marksAndWindowAreUndone() {
    Bench b;
    QUndoStack* undo = b.dock->undoStack();
    b.time.showMarks(true);
    const auto marks = b.time.shown()->marks();
    QCOMPARE(undo->count(), 1);
    auto* window = b.dock->findChild<QToolButton*>(QStringLiteral("plotWindow"));
    menu_entry::called(window->menu()->actions(), QStringLiteral("30 s"))->trigger();
    QCOMPARE(b.time.window(), 30.0);
    QCOMPARE(undo->count(), 2);
    undo->undo();
    QCOMPARE(b.time.window(), SourceKind::Simulate.window);
    QVERIFY(b.time.shown()->hasMarks());
    undo->undo();
    QVERIFY(!b.time.shown()->hasMarks());
    undo->redo();
    QCOMPARE(b.time.shown()->marks(), marks);
    QCOMPARE(undo->count(), 2);
    // A match that is put back drops marks of a time that has not come: nobody's step.
    emit b.source.rewound(0.1);
    QVERIFY(!b.time.shown()->hasMarks());
    QCOMPARE(undo->count(), 2);
  }

  void eachKindOfSourceHasItsWindow() {
    Bench b;
    class LiveSource : public PlotSource {
     public:
      const SourceKind& kind() const override { return SourceKind::Live; }
    } live;
    b.sources.add(&live);
    QCOMPARE(b.time.window(), 15.0);
    b.sources.choose(&live);
    QCOMPARE(b.time.window(), 60.0);
    b.time.setWindow(120.0);
    b.sources.choose(&b.source);
    QCOMPARE(b.time.window(), 15.0);
    b.sources.choose(&live);
    QCOMPARE(b.time.window(), 120.0);
    // The next time, too.
    b.dock.reset();
    b.sources.choose(&b.source);
    LinkedTime time(&b.sources);
    PlotsContext context = b.context();
    context.time = &time;
    PlotsDock again(context, nullptr);
    QCOMPARE(time.window(), 15.0);
    b.sources.choose(&live);
    QCOMPARE(time.window(), 120.0);
  }

  void aLayoutThatCannotBeRestoredReportsWhy() {
    Bench b;
    b.settings.setValue(QStringLiteral("plots/layout"),
                        QStringLiteral("{\"pitchboardPlots\": 99}"));
    PlotsDock dock(b.context(), nullptr);
    QVERIFY2(dock.findChild<NoticeBar*>()->text().contains(QStringLiteral("version 99")),
             qPrintable(dock.findChild<NoticeBar*>()->text()));
    // At the very first start there is nothing to complain of, but something to see.
    b.settings.remove(QStringLiteral("plots/layout"));
    PlotsContext context = b.context();
    context.first = {{{QStringLiteral("Plots"), {{}}}}, 0};
    context.first.pages[0].panes[0].curves << variableCurve(QStringLiteral("first/DIST"));
    PlotsDock fresh(context, nullptr);
    QVERIFY(fresh.findChild<NoticeBar*>()->text().isEmpty());
    fresh.feed()->refresh();
    QCOMPARE(fresh.currentPage()->panes().size(), 1);
  }
};

PITCHBOARD_GUI_TEST(TestPlotWork)

}  // namespace tst_plot_work

#include "tst_plot_work.moc"
