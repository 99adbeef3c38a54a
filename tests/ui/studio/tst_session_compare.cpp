// SPDX-License-Identifier: GPL-3.0-or-later
// Sessions beside the one that is shown.
#include <QContextMenuEvent>
#include <QGraphicsView>
#include <QHelpEvent>
#include <QMenu>
#include <QToolButton>
#include <QToolTip>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/session_events.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/session/session_writer.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/linked_time.h>
#include <ui/timeline/compared_menu.h>

#include "../../support/group_facts.h"
#include "chart_pane.h"
#include "compared_item.h"
#include "lane_pane.h"
#include "legend_bar.h"
#include "marks_model.h"
#include "marks_panel.h"
#include "plot_feed.h"
#include "plot_page.h"
#include "session_rig.h"
#include "timeline_strip.h"
#include "xy_pane.h"

namespace tst_session_compare {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::Studio;

namespace {

constexpr double longSeconds = 1200.0, rowsPerSecond = 50.0;

/// Different from row to row, so that a straight line is seen.
double distanceIn(int row) {
  return 100.0 + 7.0 * ((row * 37) % 11) + 30.0 * std::sin(row / 40.0);
}

/// 20 min of two robots: 4 MB of rows.
QString longSession(const QTemporaryDir& folder) {
  using namespace pitchboard::telemetry;
  const QString path = folder.filePath(QStringLiteral("long.mcap"));
  SessionInfo info;
  info.program = "pitchboard";
  info.source = "simulation";
  info.title = "long";
  SessionWriterOptions options;
  options.waitWhenFull = true;
  auto writer = SessionWriter::create(path.toStdString(), info, options);
  if (!writer) return {};
  std::vector<GroupId> groups;
  for (int number : {1, 2}) {
    groups.push_back((*writer)->addGroup(
        {"B" + std::to_string(number),
         {{"ACTION", ColumnType::Int32, "", "", ColumnKind::Enumeration, {{0, "stop"}, {1, "go"}}},
          {"DIST", ColumnType::Float64, "cm", "", ColumnKind::Number, {}},
          {"X", ColumnType::Float64, "m", "", ColumnKind::Number, {}},
          {"Y", ColumnType::Float64, "m", "", ColumnKind::Number, {}}},
         telemetry::facts({{"robot", std::to_string(number)}, {"team", "blue"}})}));
  }
  for (int row = 0; row < static_cast<int>(longSeconds * rowsPerSecond); ++row) {
    const std::uint32_t words[] = {static_cast<std::uint32_t>(row / 150 % 2)};
    const double values[] = {distanceIn(row), std::sin(row / 60.0), std::cos(row / 60.0)};
    for (const GroupId group : groups) {
      (*writer)->append(group, {row / rowsPerSecond, words, values});
    }
  }
  return (*writer)->finish() ? path : QString();
}

/// 30 s of two robots that were received five times a second, and walk round in a circle.
QString liveSession(const QTemporaryDir& folder) {
  const QString path = folder.filePath(QStringLiteral("live.mcap"));
  link::LiveOptions options;
  options.robots = 2;
  const telemetry::WallTime zero{std::chrono::seconds(1'790'000'000)};
  const auto recorder = link::LiveRecorder::create(path.toStdString(), options, zero);
  if (!recorder) return {};
  link::LivePipeline pipeline(options, zero);
  pipeline.observe(*recorder, zero);
  for (int step = 0; step < 150; ++step) {
    const auto now = zero + std::chrono::milliseconds(200 * step);
    for (const int robot : {1, 2}) {
      telemetry::TextMessage m;
      m.robot = robot;
      m.x = 520 + static_cast<int>(200 * std::cos(0.02 * step + robot));
      m.y = 390 + static_cast<int>(200 * std::sin(0.02 * step + robot));
      m.control = m.vision = m.localization = m.decision = m.imu = 1;
      const std::string text = telemetry::encode(m);
      pipeline.take({now,
                     {{0x0A000000U + static_cast<std::uint32_t>(robot)}, 41708},
                     static_cast<std::uint16_t>(1240 + robot),
                     false,
                     text});
    }
    (void)pipeline.advance(now);
  }
  return (*recorder)->finish() ? path : QString();
}

/// A minute whose referee is first received in PLAYING and kicks off later, or never.
QString refereedSession(const QTemporaryDir& folder, const char* name,
                        std::optional<double> kickOff) {
  const QString path = folder.filePath(QLatin1String(name));
  telemetry::SessionInfo info;
  info.source = "simulation";
  telemetry::SessionWriterOptions options;
  options.waitWhenFull = true;
  auto writer = telemetry::SessionWriter::create(path.toStdString(), info, options);
  if (!writer) return {};
  const auto group = (*writer)->addGroup(
      {"field",
       {{"X", telemetry::ColumnType::Float64, "m", "", telemetry::ColumnKind::Number, {}}}});
  for (int second = 0; second <= 60; ++second) {
    const double values[] = {0.1 * second};
    (*writer)->append(group, {1.0 * second, {}, values});
  }
  const auto add = [&](link::MatchEventKind kind, double time, std::optional<PlayState> state) {
    link::MatchEvent event;
    event.kind = kind;
    event.time = time;
    event.state = state;
    if (state) event.detail = labelOf(*state);
    (*writer)->append(link::sessionEvent(event));
  };
  add(link::MatchEventKind::RefereeReceived, 1.0, {});
  add(link::MatchEventKind::GameState, 1.0, PlayState::Playing);
  add(link::MatchEventKind::GameState, 3.0, PlayState::Set);
  if (kickOff) add(link::MatchEventKind::GameState, *kickOff, PlayState::Playing);
  return (*writer)->finish() ? path : QString();
}

/// Every kind of plot beside each other.
PlotLayout everyKind() {
  PaneSpec chart, lane, xy;
  chart.curves << variableCurve("B1/DIST") << variableCurve("B2/X");
  chart.curves[1].kind = CurveKind::Derivative;
  lane.kind = PaneKind::Lane;
  lane.curves << variableCurve("B1/ACTION");
  xy.kind = PaneKind::Xy;
  xy.curves << variableCurve("B1/X");
  xy.curves[0].inputs << "B1/Y";
  return {{PageSpec{"one", {chart, lane, xy}}}, 0};
}

/// The long session in a studio whose memory is too small for it.
struct LargeSession : Studio {
  QTemporaryDir files;
  LargeSession() : Studio(0) {
    window.setMemoryBudget(1);
    plots()->setLayoutSpec(everyKind());
    window.openSession(longSession(files));
  }
  PlotsDock* plots() { return window.findChild<PlotsDock*>(); }
  bool isRead() const { return window.replay()->isOpen() && window.replay()->loaded() == 1.0; }
};

}  // namespace

class TestSessionCompare : public QObject {
  Q_OBJECT

  static int ghostsOf(FieldView* field) {
    const auto* view = field->findChild<QGraphicsView*>();
    int all = 0;
    for (QGraphicsItem* item : view->scene()->items()) {
      if (const auto* compared = dynamic_cast<ComparedItem*>(item)) all += compared->robots();
    }
    return all;
  }
  /// The only session that is compared; null while it is being opened.
  static ComparedSession* compare(Studio& s, const QString& path) {
    s.window.compared()->open({path});
    if (!QTest::qWaitFor([&s] { return !s.window.compared()->isEmpty(); }, 20'000)) return nullptr;
    return s.window.compared()->all().front();
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aSecondSessionIsCompared() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(!path.isEmpty());
    auto* strip = s.window.findChild<TimelineStrip*>();
    QVERIFY(!s.action("stopComparing")->isEnabled());
    const auto ghosts = [&s] { return ghostsOf(s.window.field()); };
    // In Simulate: the match has gone on to where the session begins, and on.
    ComparedSession* compared = compare(s, path);
    QVERIFY(compared);
    QVERIFY(s.window.shown()->kind().hasPresent);
    QVERIFY(strip->comparedRect().isValid());
    s.window.shown()->seek(12.0);
    QTRY_COMPARE(ghosts(), 6);
    s.window.shown()->seek(2.0);
    QTRY_COMPARE(ghosts(), 0);
    // By events: what stands at 11 s there stands at 3 s here.
    compared->alignThere(11.0);
    QCOMPARE(compared->offset(), 0.0);
    compared->alignHere(3.0);
    QCOMPARE(compared->offset(), -8.0);
    QVERIFY2(compared->caption().contains(QStringLiteral("8.00 s")),
             qPrintable(compared->caption()));
    QTRY_COMPARE(ghosts(), 6);
    // In Replay, of itself: ghosts stand where the robots stand.
    compared->alignByTime();
    s.window.openSession(path);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    s.window.shown()->seek(11.0);
    QTRY_COMPARE(ghosts(), 6);
    // In Live there is nothing at these times; nothing breaks.
    s.window.showSource(SourceKind::Live);
    QVERIFY(!s.window.compared()->isEmpty());
    s.window.showSource(SourceKind::Replay);
    QVERIFY(s.action("stopComparing")->isEnabled());
    s.action("stopComparing")->trigger();
    QCOMPARE(ghosts(), 0);
    QVERIFY(s.window.compared()->isEmpty());
    QVERIFY(!strip->comparedRect().isValid());
  }

  /// The plots kept the window of the session before, where the new one has nothing, and the
  /// comparison belonged to it.
  void anotherSessionBeginsAnew() {
    const QTemporaryDir folder;
    Studio s(0);
    auto* time = s.window.findChild<LinkedTime*>();
    s.window.openSession(longSession(folder));
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    const QString live = liveSession(folder);
    QVERIFY(compare(s, live));
    time->setRange({600.0, 610.0});
    QVERIFY(!time->isFollowing());
    s.window.openSession(live);
    QTRY_COMPARE(s.window.replay()->path(), live);
    QVERIFY(s.window.compared()->isEmpty());
    QVERIFY(time->isFollowing());
    QVERIFY(time->range().begin < 30.0);
    // Also where both have something.
    time->setRange({3.0, 4.0});
    s.window.openSession(folder.filePath(QStringLiteral("long.mcap")));
    QTRY_VERIFY(s.window.replay()->path() != live);
    QVERIFY(time->isFollowing());
  }

  void eventsOfTheTimelineAreAlignedFromItsMenu() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    ComparedSession* compared = compare(s, path);
    QVERIFY(compared);
    s.window.shown()->seek(2.0);
    s.window.shown()->addBookmark(QStringLiteral("mine"));
    auto* strip = s.window.findChild<TimelineStrip*>();
    const auto align = [&](QPoint at) {
      bool found = false;
      QTimer::singleShot(0, &s.window, [&found] {
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        if (menu == nullptr) return;
        if (auto* action = menu->findChild<QAction*>(QStringLiteral("alignHere"))) {
          found = true;
          action->trigger();
        }
        menu->close();
      });
      QContextMenuEvent event(QContextMenuEvent::Mouse, at, strip->mapToGlobal(at));
      QApplication::sendEvent(strip, &event);
      return found;
    };
    // The strip takes a new mark with its next refresh.
    QTRY_VERIFY(align({qRound(strip->axis().pixel(2.0)), 13}));
    QVERIFY(compared->here());
    const double here = *compared->here();
    QTRY_VERIFY(!strip->comparedMarks().empty());
    QTRY_VERIFY(
        align({qRound(strip->comparedMarks().front().x), strip->comparedRect().center().y()}));
    QVERIFY(compared->there());
    QCOMPARE(compared->offset(), here - *compared->there());
  }

  void sessionsAreAlignedByTheKickOff() {
    const QTemporaryDir folder;
    Studio s(0);
    s.window.openSession(refereedSession(folder, "first.mcap", 20.0));
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    ComparedSession* compared = compare(s, refereedSession(folder, "second.mcap", 12.5));
    QVERIFY(compared);
    QCOMPARE(compared->offset(), 0.0);
    QTRY_VERIFY(compared->offsetByKickOff());
    const auto byKickOff = [&s](ComparedSession* session) {
      auto menu = std::make_unique<QMenu>();
      fillComparedMenu(menu.get(), s.window.compared(), session);
      return menu;
    };
    const QString name = QStringLiteral("comparedByKickOff");
    auto menu = byKickOff(compared);
    menu->findChild<QAction*>(name)->trigger();
    QCOMPARE(compared->offset(), 7.5);
    menu = byKickOff(compared);
    QVERIFY(!menu->findChild<QAction*>(name)->isEnabled());
    // A session without a kick-off says so.
    s.window.compared()->open({refereedSession(folder, "none.mcap", {})});
    QTRY_COMPARE(s.window.compared()->all().size(), std::size_t{2});
    ComparedSession* none = s.window.compared()->all().back();
    QVERIFY(none != compared && !none->offsetByKickOff());
    menu = byKickOff(none);
    QVERIFY(menu->findChild<QAction*>(name)->toolTip().contains(QStringLiteral("no kick-off")));
  }

  void aFileThatCannotBeComparedIsANotice() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.compared()->open({s.folder.filePath(QStringLiteral("none.mcap"))});
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("none.mcap")), qPrintable(s.notice()));
    QVERIFY(s.window.compared()->isEmpty());
  }

  void itsCurvesStandInTheSamePlots() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(!path.isEmpty());
    auto* plots = s.window.findChild<PlotsDock*>();
    QVERIFY(plots != nullptr);
    plots->plotVariables({QStringLiteral("B1/TRUE_X")});
    ComparedSession* compared = compare(s, path);
    QVERIFY(compared);
    s.window.shown()->seek(12.0);
    plots->time()->setRange({10.5, 14.5});
    auto* pane = plots->findChild<ChartPane*>();
    QVERIFY(pane != nullptr);
    const auto low = [](std::span<const CurveTrace> traces) {
      return traces.empty() || !traces.front().any ? std::nan("") : traces.front().low;
    };
    // The same match: the two curves lie on each other.
    QTRY_VERIFY(!std::isnan(low(pane->comparedTraces())));
    QTRY_COMPARE(low(pane->comparedTraces()), low(pane->traces()));
    // Moved by 3 s: what is drawn at 13.5 s is what was there at 10.5 s.
    compared->setOffset(3.0);
    QTRY_VERIFY(!pane->comparedTraces().empty() && pane->comparedTraces().front().any);
    const auto first = [](const CurveTrace& trace) {
      return trace.exact ? trace.samples.front().time : trace.columns.front().time;
    };
    QTRY_VERIFY(first(pane->comparedTraces().front()) > 12.9);
    s.window.compared()->removeAll();
    QTRY_VERIFY(std::isnan(low(pane->comparedTraces())));
  }

  /// Computed curves, lanes and one variable over another, too.
  void everyKindOfPlotHasItsCurves() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(!path.isEmpty());
    auto* plots = s.window.findChild<PlotsDock*>();
    PaneSpec chart, lane, xy;
    chart.curves << variableCurve("B1/TRUE_X");
    chart.curves[0].kind = CurveKind::Derivative;
    lane.kind = PaneKind::Lane;
    lane.curves << variableCurve("B1/DECISION_ACTION_A");
    xy.kind = PaneKind::Xy;
    xy.curves << variableCurve("B1/TRUE_X");
    xy.curves[0].inputs << "B1/TRUE_Y";
    plots->setLayoutSpec({{PageSpec{"one", {chart, lane, xy}}}, 0});
    ComparedSession* compared = compare(s, path);
    QVERIFY(compared);
    s.window.shown()->seek(12.0);
    plots->time()->setRange({10.5, 14.5});
    const auto* charts = plots->findChild<ChartPane*>();
    const auto* lanes = plots->findChild<LanePane*>();
    const auto* paths = plots->findChild<XyPane*>();
    QVERIFY(charts && lanes && paths);
    // The same match: everything lies on each other.
    const auto same = [&] {
      return !charts->comparedTraces().empty() && charts->comparedTraces()[0].any &&
             charts->comparedTraces()[0].low == charts->traces()[0].low &&
             charts->comparedTraces()[0].high == charts->traces()[0].high &&
             !lanes->stretches(0).empty() && lanes->comparedStretches(0) == lanes->stretches(0) &&
             !paths->points()[0].empty() && paths->comparedPoints(0) == paths->points()[0];
    };
    QTRY_VERIFY(same());
    // Moved by 3 s: what stands at 13.5 s is what was there at 10.5 s.
    const QPointF first = paths->points()[0].front();
    compared->setOffset(3.0);
    plots->time()->setRange({13.5, 14.5});
    const auto moved = [&] {
      return !paths->comparedPoints(0).empty() && paths->comparedPoints(0).front() == first;
    };
    QTRY_VERIFY(moved());
    constexpr double rounding = 1e-9;
    QTRY_VERIFY(!lanes->comparedStretches(0).empty() &&
                lanes->comparedStretches(0).front().begin >= 13.5 - rounding);
    s.window.compared()->removeAll();
    const auto gone = [&] {
      return lanes->comparedStretches(0).empty() && paths->comparedPoints(0).empty() &&
             charts->comparedTraces().empty();
    };
    QTRY_VERIFY(gone());
  }

  /// Whatever the memory holds: nothing but a click on the timeline is needed to see the rows.
  void aSessionLargerThanMemoryLooksLikeOneThatFits_data() {
    QTest::addColumn<bool>("compared");
    QTest::newRow("alone") << false;
    QTest::newRow("beside itself") << true;
  }
  void aSessionLargerThanMemoryLooksLikeOneThatFits() {
    QFETCH(bool, compared);
    QTemporaryDir folder;
    const QString path = longSession(folder);
    QVERIFY(!path.isEmpty());
    const auto open = [&](Studio& s, int megabytes) {
      s.window.setMemoryBudget(megabytes);
      s.window.findChild<PlotsDock*>()->setLayoutSpec(everyKind());
      s.window.findChild<PlotsDock*>()->setFixedHeight(240);
      s.window.openSession(path);
      if (!QTest::qWaitFor([&s] { return s.window.replay()->isOpen(); })) return false;
      ComparedSession* other = compared ? compare(s, path) : nullptr;
      const auto ready = [&] {
        return s.window.replay()->loaded() == 1.0 && (!compared || other != nullptr);
      };
      if (!QTest::qWaitFor(ready)) return false;
      if (compared) other->setOffset(-3.37);
      // Short enough for every sample to be drawn.
      s.window.findChild<PlotsDock*>()->time()->setWindow(15.0);
      return true;
    };
    const auto picture = [](Studio& s) {
      return s.window.findChild<PlotsDock*>()->grab().toImage();
    };

    Studio fits(0), pages(0);
    QVERIFY(open(fits, 1024) && open(pages, 1));
    auto* strip = pages.window.findChild<TimelineStrip*>();
    const auto* pane = pages.window.findChild<ChartPane*>();
    QVERIFY(strip && pane);
    const auto* legend = pane->findChild<LegendBar*>();
    // At the beginning, too, where nobody has clicked yet.
    for (const double time : {0.0, 300.0, 1100.0, 310.0, 700.0}) {
      if (time > 0.0) {
        const QPoint at(qRound(strip->axis().pixel(time)), strip->bandRect().center().y());
        QTest::mouseClick(strip, Qt::LeftButton, {}, at);
      }
      const double shown = pages.window.shown()->time();
      QVERIFY2(std::abs(shown - time) < 5.0, qPrintable(QString::number(shown)));
      fits.window.shown()->seek(shown);
      QTRY_VERIFY2(picture(pages) == picture(fits), qPrintable(QString::number(time)));
      // Not only the same, but the rows of the file.
      const auto row = static_cast<int>(std::floor(shown * rowsPerSecond + 1e-6));
      QCOMPARE(legend->entries().value(0).value, valueText(distanceIn(row)));
      QVERIFY(pane->traces()[0].exact);
      for (const telemetry::Sample& sample : pane->traces()[0].samples) {
        QCOMPARE(sample.value, distanceIn(qRound(sample.time * rowsPerSecond)));
      }
    }
    // A range that is longer than what fits is an envelope: never lines between single rows.
    pages.window.findChild<PlotsDock*>()->time()->setRange({0.0, longSeconds});
    QTRY_VERIFY(!pane->traces()[0].exact && pane->traces()[0].columns.size() > 100);
    // Moments are read all the same.
    pages.window.shown()->seek(456.0);
    QTRY_COMPARE(legend->entries().value(0).value, valueText(distanceIn(456 * 50)));
  }

  // B1 keeps the goal, and its rows are the first in the file.
  void theFirstPlotIsTheSameWhateverIsReadFirst() {
    Studio made(0);
    made.controller.open(link::loadScenario("kick-off").value(), true);
    made.controller.runTo(60);
    QTRY_VERIFY_WITH_TIMEOUT(made.played(60), 20'000);
    const QString path = made.recorded(1200);
    QVERIFY(!path.isEmpty());
    for (const int megabytes : {1024, 8}) {
      Studio s(0);
      s.window.setMemoryBudget(megabytes);
      s.window.openSession(path);
      QTRY_VERIFY(s.window.replay()->isOpen() && s.window.replay()->loaded() == 1.0);
      const auto inputs = [&s] {
        const auto& curves = s.window.findChild<PlotsDock*>()->currentPage()->panes()[0]->curves();
        return curves.empty() ? QStringList() : curves[0].spec().inputs;
      };
      QTRY_COMPARE(inputs(), QStringList(QStringLiteral("B2/VISION_BALL_DIST")));
    }
  }

  // Field, cards, variables and plots of a moment, whichever way somebody came to it.
  void everyPathToAMomentLooksTheSame_data() {
    QTest::addColumn<QString>("way");
    for (const char* way : {"click", "drag", "keys", "seconds", "events", "play"}) {
      QTest::newRow(way) << QString(way);
    }
  }
  void everyPathToAMomentLooksTheSame() {
    QFETCH(QString, way);
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(!path.isEmpty());
    s.window.openSession(path);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent && s.window.replay()->loaded() == 1.0);
    session_rig::closeNotice(s.window);
    ShownMoment* timeline = s.window.shown();
    auto* plots = s.window.findChild<PlotsDock*>();
    auto* strip = s.window.findChild<TimelineStrip*>();
    const auto press = [&s](int key, Qt::KeyboardModifiers keys = {}) {
      QTest::keyClick(&s.window, static_cast<Qt::Key>(key), keys);
    };
    const auto pictures = [&] {
      // The same stretch of time, however far somebody has scrolled on the way.
      plots->time()->setRange(*timeline->available());
      std::vector<QImage> all;
      for (QWidget* one :
           {static_cast<QWidget*>(s.window.field()), static_cast<QWidget*>(plots->currentPage()),
            s.window.findChild<QWidget*>("robots"), s.window.findChild<QWidget*>("variables")}) {
        all.push_back(one->grab().toImage());
      }
      return all;
    };
    const auto at = [strip](double time) {
      return QPoint(qRound(strip->axis().pixel(time)), strip->height() - 4);
    };
    timeline->seek(11.0);
    s.window.activateWindow();
    s.window.field()->setFocus();
    if (way == "click") {
      QTest::mouseClick(strip, Qt::LeftButton, {}, at(13.0));
    } else if (way == "drag") {
      QTest::mousePress(strip, Qt::LeftButton, {}, at(10.5));
      for (const double time : {11.0, 12.0, 14.0, 13.0}) {
        const QPointF to = at(time);
        QMouseEvent move(QEvent::MouseMove, to, strip->mapToGlobal(to), Qt::NoButton,
                         Qt::LeftButton, {});
        QApplication::sendEvent(strip, &move);
      }
      QTest::mouseRelease(strip, Qt::LeftButton, {}, at(13.0));
    } else if (way == "keys") {
      for (int i = 0; i < 5; ++i) press(Qt::Key_Right);
      press(Qt::Key_Left);
    } else if (way == "seconds") {
      press(Qt::Key_Right, Qt::ShiftModifier);
      press(Qt::Key_Right, Qt::ShiftModifier);
      press(Qt::Key_Left, Qt::ShiftModifier);
    } else if (way == "events") {
      press(Qt::Key_N, Qt::ShiftModifier);
      press(Qt::Key_N);
      press(Qt::Key_N);
    } else {
      press(Qt::Key_Space);
      QTRY_VERIFY(timeline->time() > 11.4);
      press(Qt::Key_Space);
      QVERIFY(timeline->isPaused());
    }
    const double time = timeline->time();
    QVERIFY2(time != 11.0, qPrintable(QString::number(time)));
    s.window.field()->setFocus();
    // Once what is read on other threads has come.
    const auto arrived = [&] {
      const FramePtr frame = timeline->frame();
      return frame && std::abs(frame->snapshot.time - time) < 0.02;
    };
    QTRY_VERIFY(arrived());
    std::vector<QImage> first = pictures();
    QTRY_VERIFY(std::exchange(first, pictures()) == first);
    timeline->seek(14.5);
    QTRY_VERIFY(pictures() != first);
    timeline->seek(time);
    QTRY_VERIFY(arrived());
    std::vector<QImage> again;
    const auto same = [&] { return (again = pictures()) == first; };
    QTRY_VERIFY2(same(), qPrintable(way));
  }

  void trailsOfLiveRobotsLookTheSameOnEveryPath() {
    Studio s(0);
    const QTemporaryDir files;
    s.window.openSession(liveSession(files));
    QTRY_VERIFY(s.window.replay()->isOpen() && s.window.replay()->loaded() == 1.0);
    session_rig::closeNotice(s.window);
    ShownMoment* timeline = s.window.shown();
    const auto pictureAt = [&](double time) {
      timeline->seek(time);
      const auto arrived = [&] {
        const FramePtr frame = timeline->frame();
        return frame && std::abs(frame->snapshot.time - time) < 0.02;
      };
      return QTest::qWaitFor(arrived) ? s.window.field()->grab().toImage() : QImage();
    };
    const QImage jumped = pictureAt(20.0);
    QVERIFY(!jumped.isNull() && pictureAt(2.0) != jumped);
    // Step by step, and from the future.
    for (double time = 18.0; time < 20.0; time += 0.25) QVERIFY(!pictureAt(time).isNull());
    QCOMPARE(pictureAt(20.0), jumped);
    QVERIFY(pictureAt(20.5) != jumped);
    QCOMPARE(pictureAt(20.0), jumped);
    s.action("layer.trails")->setChecked(false);
    QTRY_VERIFY(s.window.field()->grab().toImage() != jumped);
  }

  void anEnvelopeIsMarkedAndCompletesByItself() {
    LargeSession s;
    QTRY_VERIFY(s.isRead());
    auto* plots = s.plots();
    const auto* pane = s.window.findChild<ChartPane*>();
    plots->time()->setRange({0.0, longSeconds});  // every summary is read
    QTRY_VERIFY(pane->traces()[0].coarse && pane->traces()[0].columns.size() > 100);
    QTRY_COMPARE(pane->captions(),
                 QStringList(QStringLiteral("envelope: zoom in to see every sample")));
    const auto tipAt = [pane](QPoint at) {
      QHelpEvent help(QEvent::ToolTip, at, pane->surface()->mapToGlobal(at));
      QCoreApplication::sendEvent(pane->surface(), &help);
      return QToolTip::text();
    };
    const QPoint mark(pane->surface()->width() - 60, 14);
    QVERIFY2(tipAt(mark).contains(QStringLiteral("memory limit")), qPrintable(tipAt(mark)));
    QToolTip::hideText();
    const auto band = pane->surface()->grab().toImage();
    // Rows say that they have come, whoever looks.
    QSignalSpy came(s.window.replay(), &FrameSource::rowsCame);
    plots->time()->setRange({800.0, 810.0});
    QTRY_VERIFY(pane->traces()[0].exact && !pane->traces()[0].coarse);
    QTRY_VERIFY(!came.isEmpty());
    QTRY_VERIFY(pane->captions().isEmpty());
    QVERIFY(pane->surface()->grab().toImage() != band);
  }

  void theWholeSessionIsMeasured() {
    LargeSession s;
    QTRY_VERIFY(s.isRead());
    auto* plots = s.plots();
    plots->time()->setRange({100.0, 110.0});
    plots->time()->showMarks(true);
    auto* panel = plots->currentPage()->marksPanel();
    QTRY_VERIFY(panel->isVisible());
    const auto mean = [&] { return panel->model()->index(0, MarksModel::Mean).data().toString(); };
    auto* span = panel->findChild<QToolButton*>(QStringLiteral("statisticsSpan"));
    span->menu()->actions()[1]->trigger();
    QCOMPARE(span->text(), QStringLiteral("Whole session"));
    double sum = 0.0, squares = 0.0, low = 1e9, high = -1e9;
    const int rows = static_cast<int>(longSeconds * rowsPerSecond);
    for (int row = 0; row < rows; ++row) {
      const double value = distanceIn(row);
      sum += value;
      squares += value * value;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    QTRY_COMPARE(mean(), valueText(sum / rows));
    QCOMPARE(panel->model()->index(0, MarksModel::Rms).data().toString(),
             valueText(std::sqrt(squares / rows)));
    QCOMPARE(panel->model()->index(0, MarksModel::Min).data().toString(), valueText(low));
    QCOMPARE(panel->model()->index(0, MarksModel::Max).data().toString(), valueText(high));
    span->menu()->actions()[0]->trigger();
    QTRY_VERIFY(mean() != valueText(sum / rows));
  }

  void itIsMovedByHand() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    ComparedSession* compared = compare(s, path);
    QVERIFY(compared);
    auto* strip = s.window.findChild<TimelineStrip*>();
    const QRect row = strip->comparedRect();
    const QPoint from(row.center()), to(row.center() + QPoint(60, 0));
    QTest::mousePress(strip, Qt::LeftButton, {}, from);
    QTest::mouseMove(strip, to);
    QTest::mouseRelease(strip, Qt::LeftButton, {}, to);
    const double moved = 60.0 * strip->axis().secondsPerPixel();
    QVERIFY(std::abs(compared->offset() - moved) < 0.05 * moved + 0.05);
    QVERIFY(!s.window.compared()->areAlignedByTime());
    s.window.compared()->alignAllByTime();
    QCOMPARE(compared->offset(), 0.0);
  }
};

PITCHBOARD_GUI_TEST(TestSessionCompare)

}  // namespace tst_session_compare

#include "tst_session_compare.moc"
