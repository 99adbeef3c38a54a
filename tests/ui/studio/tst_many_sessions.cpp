// SPDX-License-Identifier: GPL-3.0-or-later
// Several sessions beside the one that is shown: curves, values, robots, rows of the timeline, and
// what happens when one is aligned, removed or cannot be opened.
#include <QBuffer>
#include <QContextMenuEvent>
#include <QDropEvent>
#include <QGraphicsView>
#include <QMenu>
#include <QMimeData>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include <telemetry/session/session_reader.h>
#include <ui/base/robot_text.h>
#include <ui/base/session_mark.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/linked_time.h>

#include "../../support/program_run.h"
#include "../event_loop_watchdog.h"
#include "chart_pane.h"
#include "compared_item.h"
#include "lane_pane.h"
#include "legend_bar.h"
#include "marks_model.h"
#include "marks_panel.h"
#include "plot_export.h"
#include "plot_page.h"
#include "session_rig.h"
#include "timeline_strip.h"

namespace tst_many_sessions {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int patience_ms = 30'000;
const QString variable = QStringLiteral("B1/TRUE_X");

/// The samples of a file, without the studio.
std::vector<telemetry::Sample> samplesOf(const QString& path, const QString& name,
                                         telemetry::TimeRange range) {
  const auto session = telemetry::SessionReader::open(path.toStdString());
  std::vector<telemetry::Sample> samples;
  if (!session || !session->range()) return samples;
  telemetry::SeriesStore rows;
  std::vector<telemetry::GroupId> ids;
  for (const auto& group : session->groups()) ids.push_back(rows.addGroup(group.info));
  session->rows(*session->range(), {}, [&](telemetry::GroupId group, const auto& row) {
    rows.append(ids[group], row);
    return true;
  });
  const auto id = findVariable(rows, name);
  if (id) rows.view(id->group)->samples(id->column, range, samples, 100'000);
  return samples;
}

struct Studio : session_rig::Studio {
  explicit Studio(const QString& shown) : session_rig::Studio(0) {
    window.openSession(shown);
    const auto isRead = [this] {
      return window.replay()->isOpen() && window.replay()->loaded() == 1.0;
    };
    if (!QTest::qWaitFor(isRead, patience_ms)) qFatal("the session does not open");
  }
  ComparedSessions* compared() const { return window.compared(); }
  ComparedSession* session(std::size_t index) const { return compared()->all().at(index); }
  TimelineStrip* strip() const { return window.findChild<TimelineStrip*>(); }
  PlotsDock* plots() const { return window.findChild<PlotsDock*>(); }
  template <class Pane>
  Pane* pane() const {
    return qobject_cast<Pane*>(plots()->currentPage()->panes().front());
  }
  ChartPane* chart() const { return pane<ChartPane>(); }
  /// Opens files beside it and waits until they are there.
  bool compare(const QStringList& paths) const {
    const std::size_t all = compared()->all().size() + static_cast<std::size_t>(paths.size());
    compared()->open(paths);
    return QTest::qWaitFor([&] { return compared()->all().size() == all; }, patience_ms);
  }
  void plot(PaneKind kind, const QString& name) const {
    PaneSpec pane;
    pane.kind = kind;
    pane.curves << variableCurve(name);
    plots()->setLayoutSpec({{PageSpec{QStringLiteral("one"), {pane}}}, 0});
  }
  /// The trace of a compared session has exactly the samples of its file, moved by its offset.
  bool draws(std::size_t index, const QString& file) const {
    const auto traces = chart()->comparedTraces(index);
    if (traces.empty() || !traces[0].any || !traces[0].exact) return false;
    const double offset = session(index)->offset();
    const telemetry::TimeRange range = plots()->time()->range();
    std::vector<telemetry::Sample> drawn = traces[0].samples;
    std::erase_if(drawn, [range](const telemetry::Sample& sample) {
      return sample.time < range.begin || sample.time > range.end;
    });
    const auto stored = samplesOf(file, variable, {range.begin - offset, range.end - offset});
    return !stored.empty() && drawn.size() == stored.size() &&
           std::ranges::equal(drawn, stored, [offset](const auto& a, const auto& b) {
             return a.value == b.value && std::abs(a.time - offset - b.time) < 1e-9;
           });
  }
  std::vector<const ComparedItem*> ghosts() const {
    std::vector<const ComparedItem*> all;
    for (QGraphicsItem* item : window.field()->findChild<QGraphicsView*>()->scene()->items()) {
      if (const auto* one = dynamic_cast<ComparedItem*>(item)) all.push_back(one);
    }
    return all;
  }
  /// Chooses an entry of the menu that opens here; false if there is none.
  bool choose(QPoint at, const char* entry) {
    bool found = false;
    QTimer::singleShot(0, &window, [&found, entry] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      if (menu == nullptr) return;
      auto* action = menu->findChild<QAction*>(QLatin1String(entry));
      found = action != nullptr && action->isEnabled();
      menu->close();
      if (found) action->trigger();
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, strip()->mapToGlobal(at));
    QApplication::sendEvent(strip(), &event);
    return found;
  }
};

bool isDropped(QWidget* at, const QStringList& paths) {
  QMimeData data;
  QList<QUrl> urls;
  for (const QString& path : paths) urls << QUrl::fromLocalFile(path);
  data.setUrls(urls);
  const QPoint middle = at->rect().center();
  QDragEnterEvent enter(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(at, &enter);
  QDropEvent drop(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(at, &drop);
  return enter.isAccepted() && drop.isAccepted();
}

/// Relative luminance as of WCAG 2.
double luminance(const QColor& color) {
  const auto linear = [](double part) {
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double contrast(const QColor& a, const QColor& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

/// Difference of colours in OKLab (Ottosson 2020), about 0.02 where people begin to see it.
double difference(const QColor& first, const QColor& second) {
  const auto lab = [](const QColor& color) {
    const auto linear = [](double part) {
      return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
    };
    const double r = linear(color.redF()), g = linear(color.greenF()), b = linear(color.blueF());
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return std::array{0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
                      1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
                      0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
  };
  const auto a = lab(first), b = lab(second);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

class TestManySessions : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QStringList m_files;  // of one scenario with three seeds

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    for (const char* seed : {"1", "2", "3"}) {
      const QString path =
          m_folder.filePath(QStringLiteral("seed-%1.mcap").arg(QLatin1String(seed)));
      const ProgramRun run = cli({"record", "--scenario", "match-3v3", "--duration", "12", "--seed",
                                  QLatin1String(seed), "-o", path});
      QVERIFY2(run.exitCode == 0, run.err.constData());
      m_files << path;
    }
  }

  void coloursAreToldApart() {
    for (const ThemeChoice choice : {ThemeChoice::Dark, ThemeChoice::Light}) {
      setTheme(*qApp, choice);
      std::vector<QColor> others;
      for (const TeamColor team : {TeamColor::Blue, TeamColor::Red, TeamColor::Black,
                                   TeamColor::Orange, TeamColor::Yellow}) {
        others.push_back(theme().team(team));
      }
      for (int i = 0; i < curveColors; ++i) others.push_back(curveColor(i));
      for (int number = 1; number <= maxComparedSessions; ++number) {
        const QColor color = sessionColor(number);
        for (const QColor& other : others) {
          QVERIFY2(difference(color, other) > 0.07, qPrintable(QString::number(number)));
        }
        QVERIFY(contrast(color, theme().view) >= 3.0);
        QVERIFY(contrast(color, theme().window) >= 3.0);
        others.push_back(color);
      }
    }
    setTheme(*qApp, ThemeChoice::Dark);
  }

  void eachHasItsCurve() {
    Studio s(m_files[0]);
    s.plot(PaneKind::Chart, variable);
    QVERIFY(s.compare({m_files[1], m_files[2]}));
    s.window.shown()->seek(8.0);
    s.plots()->time()->setRange({5.0, 9.0});
    QTRY_VERIFY_WITH_TIMEOUT(s.draws(0, m_files[1]) && s.draws(1, m_files[2]), patience_ms);
    // They are other matches.
    QVERIFY(s.chart()->comparedTraces(0)[0].low != s.chart()->comparedTraces(1)[0].low);
    // One of them is aligned by an event; the other stays where it is.
    s.session(1)->alignHere(6.5);
    s.session(1)->alignThere(4.0);
    QCOMPARE(s.session(1)->offset(), 2.5);
    QCOMPARE(s.session(0)->offset(), 0.0);
    QTRY_VERIFY(s.draws(0, m_files[1]) && s.draws(1, m_files[2]));
    // Legend and table say whose values they are.
    const auto last = [](const QString& path, double time) {
      return samplesOf(path, variable, {time - 0.5, time + 1e-9}).back().value;
    };
    const auto entry = [&s](int index) { return s.chart()->legend()->entries().value(index); };
    QTRY_COMPARE(s.chart()->legend()->entries().size(), 3);
    QTRY_COMPARE(entry(2).value, valueText(last(m_files[2], 5.5)));
    QCOMPARE(entry(1).value, valueText(last(m_files[1], 8.0)));
    QCOMPARE(entry(1).text, entry(0).text + QStringLiteral("′"));
    QCOMPARE(entry(2).text, entry(0).text + QStringLiteral("′₂"));
    QCOMPARE(entry(2).color, sessionColor(2));
    QVERIFY2(entry(2).tip.contains(QStringLiteral("seed-3 · +2.50 s")), qPrintable(entry(2).tip));
    s.window.shown()->setMarks({6.0, 8.0});
    const auto* table = s.plots()->currentPage()->marksPanel()->model();
    QTRY_COMPARE(table->rows().size(), 3);
    QTRY_COMPARE(table->rows()[2].a, std::optional(last(m_files[2], 3.5)));
    QCOMPARE(table->rows()[2].b, std::optional(last(m_files[2], 5.5)));
    QCOMPARE(table->rows()[1].b, std::optional(last(m_files[1], 8.0)));
    const auto between = samplesOf(m_files[2], variable, {3.5, 5.5});
    double sum = 0.0;
    for (const telemetry::Sample& sample : between) sum += sample.value;
    QCOMPARE(table->rows()[2].between.samples, between.size());
    QVERIFY(std::abs(table->rows()[2].between.mean - sum / double(between.size())) < 1e-9);
    QVERIFY(table->text().contains(entry(0).text + QStringLiteral("′₂")));
    // So does what is exported: the same samples, at the times at which they are drawn.
    QBuffer buffer;
    buffer.open(QIODevice::ReadWrite);
    writeCsv(buffer, s.plots()->currentPage()->panes(), {7.0, 7.1});
    const QString csv = QString::fromUtf8(buffer.data());
    QVERIFY2(csv.contains(QStringLiteral("′₂ seed-3 · +2.50 s")), qPrintable(csv));
    for (const telemetry::Sample& sample : samplesOf(m_files[2], variable, {4.5, 4.6})) {
      QVERIFY(csv.contains(QString::number(sample.value, 'g', 17)));
    }
    // A click in the legend hides a session's curves, another one shows them again.
    const auto click = [&] {
      QTest::mouseClick(s.chart()->legend(), Qt::LeftButton, {},
                        s.chart()->legend()->rectOf(1).center());
    };
    QVERIFY(!s.chart()->legend()->rectOf(1).isEmpty());
    click();
    QVERIFY(!s.session(0)->isInPlots());
    QTRY_VERIFY(!s.chart()->comparedTraces(0)[0].any && entry(1).hidden);
    QVERIFY(s.draws(1, m_files[2]));
    click();
    QTRY_VERIFY(s.draws(0, m_files[1]));
  }

  void lanesHaveABandForEach() {
    Studio s(m_files[0]);
    s.plot(PaneKind::Lane, QStringLiteral("B1/DECISION_ACTION_A"));
    const auto* lanes = s.pane<LanePane>();
    const int low = lanes->height();
    QVERIFY(s.compare({m_files[0], m_files[1], m_files[2]}));
    s.window.shown()->seek(8.0);
    s.plots()->time()->setRange({4.0, 9.0});
    QTRY_VERIFY(!lanes->comparedStretches(0, 2).empty());
    QTRY_VERIFY(!lanes->stretches(0).empty() &&
                lanes->comparedStretches(0, 0) == lanes->stretches(0));
    QVERIFY(lanes->height() > low);
    QVERIFY(!lanes->comparedStretches(0, 1).empty());
    // The lowest band is the last one's.
    const QRect area = lanes->lineAreas().front();
    bool found = false;
    for (int y = area.top(); y < area.bottom() && !found; ++y) {
      found =
          lanes->tipAt({area.center().x() * 1.0, y * 1.0}).startsWith(QStringLiteral("′₃ seed-3"));
    }
    QVERIFY(found);
  }

  void theOthersKeepColourAndAlignment() {
    Studio s(m_files[0]);
    s.plot(PaneKind::Chart, variable);
    QVERIFY(s.compare(m_files));
    s.window.shown()->seek(8.0);
    s.plots()->time()->setRange({5.0, 9.0});
    s.session(0)->setOffset(0.5);
    s.session(2)->setOffset(-1.25);
    QTRY_VERIFY(s.draws(2, m_files[2]));
    QTRY_COMPARE(s.ghosts().size(), 3U);
    const ComparedSession *first = s.session(0), *last = s.session(2);
    const QRect row = s.strip()->comparedRect(1);
    QVERIFY(s.choose({row.left() + 3, row.center().y()}, "comparedRemove"));
    QTRY_COMPARE(s.compared()->all().size(), 2U);
    QVERIFY(s.session(0) == first && s.session(1) == last);
    QCOMPARE(first->number(), 1);
    QCOMPARE(last->number(), 3);
    QCOMPARE(first->offset(), 0.5);
    QCOMPARE(last->offset(), -1.25);
    QTRY_VERIFY(s.draws(0, m_files[0]) && s.draws(1, m_files[2]));
    QTRY_COMPARE(s.ghosts().size(), 2U);
    // The next one gets the colour that is free.
    QVERIFY(s.compare({m_files[1]}));
    QCOMPARE(s.session(2)->number(), 2);
    QCOMPARE(s.session(0)->offset(), 0.5);
    s.action("stopComparing")->trigger();
    QVERIFY(s.compared()->isEmpty());
    QTRY_VERIFY(s.ghosts().empty());
  }

  void theSameFileTwice() {
    Studio s(m_files[0]);
    s.plot(PaneKind::Chart, variable);
    QVERIFY(s.compare({m_files[1], m_files[1]}));
    s.window.shown()->seek(8.0);
    s.plots()->time()->setRange({5.0, 9.0});
    s.session(1)->setOffset(2.0);
    QTRY_VERIFY(s.draws(0, m_files[1]) && s.draws(1, m_files[1]));
    QVERIFY(s.session(0)->number() != s.session(1)->number());
    QTRY_COMPARE(s.chart()->captions(),
                 QStringList(QStringLiteral("thin: ′ seed-2, ′₂ seed-2 · +2.00 s")));
  }

  void oneThatFailsLeavesTheOthers() {
    Studio s(m_files[0]);
    const QString broken = m_folder.filePath(QStringLiteral("broken.mcap"));
    QFile file(broken);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("no session") > 0);
    file.close();
    s.compared()->open(
        {m_files[1], m_folder.filePath(QStringLiteral("none.mcap")), broken, m_files[2]});
    QTRY_VERIFY2_WITH_TIMEOUT(s.notice().contains(QStringLiteral("none.mcap")),
                              qPrintable(s.notice()), patience_ms);
    QVERIFY2(s.notice().contains(QStringLiteral("broken.mcap")), qPrintable(s.notice()));
    QCOMPARE(s.compared()->all().size(), 2U);
    QCOMPARE(s.session(0)->path(), m_files[1]);
    QCOMPARE(s.session(1)->path(), m_files[2]);
    QCOMPARE(s.session(1)->number(), 2);
    // The notice stays when something else changes, and goes with the next attempt.
    s.session(0)->setOffset(1.0);
    QVERIFY(s.notice().contains(QStringLiteral("none.mcap")));
    QVERIFY(s.compare({m_files[1]}));
    QVERIFY(!s.notice().contains(QStringLiteral("none.mcap")));
  }

  void sixteenAreTheMost() {
    Studio s(m_files[0]);
    const int low = s.strip()->sizeHint().height();
    QStringList many;
    for (int i = 0; i < 17; ++i) many << m_files[static_cast<qsizetype>(i % 3)];
    s.compared()->open(many);
    QTRY_VERIFY2_WITH_TIMEOUT(
        s.notice().contains(QStringLiteral("At most 16 sessions can be compared")) &&
            s.notice().contains(QStringLiteral("seed-2.mcap")),
        qPrintable(s.notice()), patience_ms);
    QCOMPARE(s.compared()->all().size(), 16U);
    // Rows become low, and scroll.
    TimelineStrip* strip = s.strip();
    QTRY_VERIFY(strip->height() > low);
    QVERIFY2(strip->height() < low + 110, qPrintable(QString::number(strip->height())));
    QVERIFY(strip->comparedRect(0).isValid() && strip->comparedRect(15).isEmpty());
    auto* bar = strip->findChild<QScrollBar*>(QStringLiteral("comparedScroll"));
    QTRY_VERIFY(bar->isVisible());
    const QPointF chip = strip->comparedChip(0).center();
    for (int i = 0; i < 16; ++i) {
      QWheelEvent down(chip, strip->mapToGlobal(chip), {}, {0, -120}, {}, {}, Qt::NoScrollPhase,
                       false);
      QApplication::sendEvent(strip, &down);
    }
    QVERIFY(strip->comparedRect(0).isEmpty() && strip->comparedRect(15).isValid());
    const QRect last = strip->comparedRect(15);
    QVERIFY(last.bottom() < strip->bandRect().top());
    QVERIFY(s.choose({last.left() + 3, last.center().y()}, "comparedRemove"));
    QTRY_COMPARE(s.compared()->all().size(), 15U);
    QCOMPARE(s.session(14)->number(), 15);
    QVERIFY(s.choose({last.left() + 3, last.center().y()}, "comparedRemoveAll"));
    QTRY_COMPARE(strip->sizeHint().height(), low);
    QVERIFY(!bar->isVisible());
  }

  void eventsAreAlignedRowByRow() {
    Studio s(m_files[0]);
    QVERIFY(s.compare({m_files[1], m_files[2]}));
    TimelineStrip* strip = s.strip();
    QTRY_VERIFY(!strip->marks().empty() && !strip->comparedMarks(1).empty());
    const double before = s.session(0)->offset();
    const auto own = [&] { return QPoint(qRound(strip->marks().front().x), 13); };
    const double here = s.window.shown()->events()->at(strip->marks().front().row).time;
    // Of what is shown: for which session is asked.
    // The strip is laid out anew for its rows.
    QTRY_VERIFY(s.choose(own(), "alignHere.2"));
    QCOMPARE(s.session(1)->here(), std::optional(here));
    QVERIFY(!s.session(0)->here());
    const EventMark mark = strip->comparedMarks(1).back();
    const double there = s.session(1)->events()->at(mark.row).time;
    const QRect row = strip->comparedRect(1);
    QVERIFY(s.choose({std::min(qRound(mark.x), row.right() - 1), row.center().y()}, "alignHere"));
    QCOMPARE(s.session(1)->offset(), here - there);
    QCOMPARE(s.session(0)->offset(), before);
    // Dragging moves the row that is dragged.
    const QPoint from(strip->comparedRect(0).left() + 40, strip->comparedRect(0).center().y());
    QTest::mousePress(strip, Qt::LeftButton, {}, from);
    QTest::mouseMove(strip, from + QPoint(50, 0));
    QTest::mouseRelease(strip, Qt::LeftButton, {}, from + QPoint(50, 0));
    QVERIFY(s.session(0)->offset() > 0.1);
    QCOMPARE(s.session(1)->offset(), here - there);
    QVERIFY(s.choose(strip->comparedRect(0).center() - QPoint(200, 0), "comparedByTime"));
    QCOMPARE(s.session(0)->offset(), 0.0);
    QCOMPARE(s.session(1)->offset(), here - there);
  }

  void robotsAreHatchedInTheColourOfTheirSession() {
    Studio s(m_files[0]);
    QVERIFY(s.compare({m_files[1], m_files[2]}));
    s.window.shown()->seek(8.0);
    QTRY_COMPARE(s.ghosts().size(), 2U);
    const auto pixels = [&s](int number) {
      const QImage picture = s.window.field()->grab().toImage();
      const QColor wanted = sessionColor(number);
      int found = 0;
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          if (difference(picture.pixelColor(x, y), wanted) < 0.02) ++found;
        }
      }
      return found;
    };
    QTRY_VERIFY(pixels(1) > 20 && pixels(2) > 20);
    // A click on its mark in the timeline takes a session off the field.
    QTest::mouseClick(s.strip(), Qt::LeftButton, {}, s.strip()->comparedChip(0).center());
    QVERIFY(!s.session(0)->isOnField());
    QTRY_COMPARE(s.ghosts().size(), 1U);
    QTRY_VERIFY(pixels(1) == 0 && pixels(2) > 20);
    s.window.shown()->seek(9.0);
    QCOMPARE(s.ghosts().size(), 1U);
    QTest::mouseClick(s.strip(), Qt::LeftButton, {}, s.strip()->comparedChip(0).center());
    QTRY_COMPARE(s.ghosts().size(), 2U);
  }

  /// Three recordings of one match have their robots at the same places.
  void namesAtTheSamePlaceAreMovedApart() {
    Studio s(m_files[0]);
    QVERIFY(s.compare({m_files[1], m_files[1], m_files[1]}));
    for (const double time : {4.0, 8.0, 11.0}) {
      s.window.shown()->seek(time);
      QTRY_COMPARE(s.ghosts().size(), 3U);
      QTRY_VERIFY(s.ghosts()[0]->robots() == 6);
      const auto areApart = [&s] {
        std::vector<std::vector<QRectF>> names;
        for (const ComparedItem* one : s.ghosts()) names.push_back(one->nameRects());
        for (std::size_t robot = 0; robot < 6; ++robot) {
          if (names[0][robot].intersects(names[1][robot]) ||
              names[0][robot].intersects(names[2][robot]) ||
              names[1][robot].intersects(names[2][robot])) {
            return false;
          }
        }
        return true;
      };
      QTRY_VERIFY(areApart());
    }
  }

  /// The session that is shown and a compared one change places.
  void oneIsOpenedInPlaceOfTheOneShown() {
    Studio s(m_files[0]);
    QVERIFY(s.compare({m_files[1], m_files[2]}));
    s.session(0)->setOffset(2.0);
    s.session(1)->setOffset(3.5);
    s.window.shown()->seek(7.0);
    const QRect row = s.strip()->comparedRect(0);
    QVERIFY(s.choose({row.left() + 3, row.center().y()}, "comparedInstead"));
    QTRY_COMPARE_WITH_TIMEOUT(s.window.replay()->path(), m_files[1], patience_ms);
    QTRY_COMPARE(s.compared()->all().size(), 2U);
    QTRY_COMPARE(s.session(1)->path(), m_files[0]);
    QCOMPARE(s.session(0)->path(), m_files[2]);
    QCOMPARE(s.session(0)->offset(), 1.5);
    QCOMPARE(s.session(1)->offset(), -2.0);
    QCOMPARE(s.window.shown()->time(), 5.0);
    // Another file that is opened ends the comparison, as always.
    s.window.openSession(m_files[2]);
    QTRY_VERIFY(s.compared()->isEmpty());
  }

  void severalFilesAreDropped() {
    Studio s(m_files[2]);
    QVERIFY(isDropped(&s.window, m_files));
    QTRY_COMPARE_WITH_TIMEOUT(s.window.replay()->path(), m_files[0], patience_ms);
    QTRY_COMPARE(s.compared()->all().size(), 2U);
    QCOMPARE(s.session(0)->path(), m_files[1]);
    QCOMPARE(s.session(1)->path(), m_files[2]);
    // On the timeline they come beside those.
    QVERIFY(isDropped(s.strip(), {m_files[0]}));
    QTRY_COMPARE(s.compared()->all().size(), 3U);
    QCOMPARE(s.window.replay()->path(), m_files[0]);
    // The menu lists them.
    auto* menu = s.window.findChild<QMenu*>(QStringLiteral("comparedSessions"));
    emit menu->aboutToShow();
    QCOMPARE(menu->actions().size(), 3);
    QCOMPARE(menu->actions()[1]->text(), QStringLiteral("′₂ seed-3"));
  }

  /// Eight recordings of ten minutes, replayed four times as fast.
  void theWindowAnswersWithEightSessions() {
    const QString path = m_folder.filePath(QStringLiteral("ten-minutes.mcap"));
    const ProgramRun run =
        cli({"record", "--scenario", "match-3v3", "--duration", "600", "--seed", "5", "-o", path});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    Studio s(path);
    PaneSpec chart, lane;
    for (const char* name : {"B1/TRUE_X", "B2/TRUE_X", "R1/TRUE_X"}) {
      chart.curves << variableCurve(QLatin1String(name));
    }
    lane.kind = PaneKind::Lane;
    lane.curves << variableCurve(QStringLiteral("B1/DECISION_ACTION_A"));
    s.plots()->setLayoutSpec({{PageSpec{QStringLiteral("one"), {chart, lane}}}, 0});
    QStringList eight;
    for (int i = 0; i < 8; ++i) eight << path;
    QVERIFY(s.compare(eight));
    for (std::size_t i = 0; i < 8; ++i) s.session(i)->setOffset(0.7 * static_cast<double>(i));
    const auto isRead = [&s] {
      const auto& all = s.compared()->all();
      return std::ranges::all_of(all, [](const ComparedSession* one) {
        const auto rows = one->series();
        return one->isRead() && rows->range();
      });
    };
    QTRY_VERIFY_WITH_TIMEOUT(isRead(), 120'000);
    s.window.shown()->seek(100.0);
    s.window.shown()->setSpeed(4.0);
    QTRY_COMPARE(s.ghosts().size(), 8U);
    tests::EventLoopWatchdog turns;
    s.window.shown()->setPaused(false);
    QTRY_VERIFY_WITH_TIMEOUT(s.window.shown()->time() > 120.0, patience_ms);
    s.window.shown()->setPaused(true);
    qInfo("longest turn of the event loop: %.1f ms of work, %.1f ms in all", turns.longest_ms(),
          turns.gap_ms());
    QVERIFY2(turns.longest_ms() < 50.0, qPrintable(QString::number(turns.longest_ms())));
  }
};

PITCHBOARD_GUI_TEST(TestManySessions)

}  // namespace tst_many_sessions

#include "tst_many_sessions.moc"
