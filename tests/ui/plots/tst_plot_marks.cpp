// SPDX-License-Identifier: GPL-3.0-or-later
// Marks A and B of the plots: where they stand, what they measure, what happened between them.

#include <QAbstractItemModelTester>
#include <QTableView>
#include <QtTest>

#include <simcore/world/action_codes.h>
#include <ui/base/theme.h>
#include <ui/plots/plots_dock.h>

#include "../support/robot_keys.h"
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

namespace tst_plot_marks {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;

class TestPlotMarks : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  /// The table beside them does not take half of the curves.
  void theCurvesStayWide() {
    for (const int width : {1000, 1600}) {
      Shown s;
      s.dock->resize(width, 300);
      const PlotPane* pane = s.dropped({"B1/DIST"});
      QCoreApplication::processEvents();
      const int before = pane->width();
      s.time.showMarks(true);
      QTRY_VERIFY(s.page()->marksPanel()->isVisible());
      QTRY_VERIFY2(pane->width() < before && pane->width() >= before * 3 / 5,
                   qPrintable(QStringLiteral("%1 of %2").arg(pane->width()).arg(before)));
      const auto* table = s.dock->findChild<QTableView*>(QStringLiteral("marksTable"));
      QVERIFY(table->columnWidth(MarksModel::Name) >= 90);
    }
  }

  void marksMeasure() {
    Shown s;
    s.dropped({"B1/DIST"});
    s.time.shown()->setMark(TimeMark::A, 4.0);
    s.time.shown()->setMark(TimeMark::B, 10.0);
    MarksModel* model = s.page()->marksPanel()->model();
    QTRY_COMPARE(model->rowCount(), 1);
    // Independently, from the definition.
    double sum = 0, squares = 0, low = 1e9, high = -1e9;
    int count = 0;
    for (int i = 4 * 60; i <= 10 * 60; ++i) {
      const double value = PlotSource::distanceAt(i / 60.0);
      sum += value;
      squares += value * value;
      low = std::min(low, value);
      high = std::max(high, value);
      ++count;
    }
    const double mean = sum / count;
    const MarksRow& row = model->rows()[0];
    QCOMPARE(row.between.samples, std::uint64_t(count));
    QVERIFY(std::abs(row.between.mean - mean) < 1e-9);
    QVERIFY(std::abs(row.between.sigma - std::sqrt(squares / count - mean * mean)) < 1e-6);
    QVERIFY(std::abs(row.between.rms - std::sqrt(squares / count)) < 1e-9);
    QCOMPARE(row.between.min, low);
    QCOMPARE(row.between.max, high);
    QCOMPARE(*row.a, PlotSource::distanceAt(4.0));
    QCOMPARE(*row.b, PlotSource::distanceAt(10.0));
    const double delta = PlotSource::distanceAt(10.0) - PlotSource::distanceAt(4.0);
    QCOMPARE(model->index(0, MarksModel::Delta).data().toString(),
             (delta > 0 ? QStringLiteral("+") : QString()) + valueText(delta));
    QVERIFY(model->text().startsWith(QStringLiteral("Curve\tA\tB")));
  }

  void headsOfMarksCanBeDragged() {
    Shown s;
    s.dropped({"B1/DIST"});
    s.time.setRange({0.0, 20.0});
    s.time.showMarks(true);
    auto* heads = s.page()->findChild<MarkHeads*>();
    QTRY_VERIFY(heads->isVisible() && heads->height() > 5);
    // A head stands above its line once both are laid out.
    const auto lineOfA = [&] {
      const QPoint left = s.pane()->surface()->mapTo(s.page(), QPoint());
      return heads->mapFrom(s.page(), left).x() +
             s.pane()->timeAxis().pixel(*s.time.shown()->mark(TimeMark::A));
    };
    QTRY_VERIFY(std::abs(heads->headRect(TimeMark::A).center().x() - lineOfA()) < 1.5);
    const QPoint from = heads->headRect(TimeMark::A).center().toPoint();
    const double before = *s.time.shown()->mark(TimeMark::A);
    drag(heads, from, from + QPoint(50, 0));
    QVERIFY(*s.time.shown()->mark(TimeMark::A) > before);
    QVERIFY(std::abs(heads->headRect(TimeMark::A).center().x() - (from.x() + 50)) < 1.5);
    // The line itself, over a plot.
    QWidget* surface = s.pane()->surface();
    const int x = int(std::lround(s.pane()->timeAxis().pixel(*s.time.shown()->mark(TimeMark::B))));
    drag(surface, {x, 30}, {x - 60, 30});
    QVERIFY(std::abs(s.pane()->timeAxis().pixel(*s.time.shown()->mark(TimeMark::B)) - (x - 60)) <
            1.5);
    s.time.showMarks(false);
    QVERIFY(!heads->isVisible());
  }

  void theMarksModelIsAModel() {
    MarksModel model;
    const QAbstractItemModelTester tester(&model,
                                          QAbstractItemModelTester::FailureReportingMode::QtTest);
    MarksRow row;
    row.name = "x";
    model.setRows({row, row});
    row.a = 1.0;
    model.setRows({row, row});
    model.setRows({row});
    model.setRows({});
    QCOMPARE(model.rowCount(), 0);
  }

  void eventsBetweenTheMarksAreNamed() {
    std::deque<link::MatchEvent> events;
    for (const double time : {1.0, 2.0, 3.0, 4.0, 9.0}) {
      events.push_back({link::MatchEventKind::Kick, time, link::uidOf(blue(1)), "B1"});
    }
    PlotBench bench;
    PlotFeed feed(&bench.source, &bench.time);
    QCOMPARE(eventsBetween(events, 5.0, 8.0, feed), QString());
    QVERIFY(eventsBetween(events, 3.5, 1.5, feed).contains(QStringLiteral("00:02.00")));
    QVERIFY(eventsBetween(events, 0.0, 10.0, feed).endsWith(QStringLiteral("and 2 more.")));
  }
};

PITCHBOARD_GUI_TEST(TestPlotMarks)

}  // namespace tst_plot_marks

#include "tst_plot_marks.moc"
