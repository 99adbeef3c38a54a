// SPDX-License-Identifier: GPL-3.0-or-later
// Which variables a curve shows: of every robot, of the first one, of other curves, in expressions
// that somebody types. Values are computed here.
#include <QCompleter>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QUndoStack>
#include <QtTest>
#include <array>
#include <map>

#include <ui/base/theme.h>

#include "curve_dialog.h"
#include "curve_template.h"
#include "derived_series.h"
#include "plot_page.h"
#include "plot_rig.h"
#include "plot_source.h"

namespace tst_plot_variables {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace plot_rig;

class TestPlotVariables : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void oneDescriptionForEveryRobot() {
    Bench b;
    PlotPane* pane = b.show(variableCurve(QStringLiteral("each/DIST")));
    QCOMPARE(namesOf(pane), QStringList({QStringLiteral("DIST B1"), QStringLiteral("DIST B2")}));
    QVERIFY(pane->curves()[0].color() != pane->curves()[1].color());
    // A robot that comes later has its curve; what is kept is the description.
    b.source.fill("B3", 10.0);
    b.dock->feed()->refresh();
    QTRY_COMPARE(pane->curves().size(), std::size_t(3));
    QCOMPARE(pane->spec().curves.size(), 1);
    QCOMPARE(pane->spec().curves[0].inputs, QStringList(QStringLiteral("each/DIST")));
    // The same in a source with other robots, or none.
    b.source.restart();
    b.source.fill("Robot 7", 10.0);
    b.dock->feed()->refresh();
    QTRY_COMPARE(namesOf(pane), QStringList(QStringLiteral("DIST Robot 7")));
    QCOMPARE(pane->curves()[0].valueAt({}), std::optional(PlotSource::distanceAt(10.0)));
    b.source.restart();
    b.dock->feed()->refresh();
    QTRY_VERIFY(pane->curves().size() == 1 && pane->curves()[0].isWaiting());
  }

  void expressionsForEveryRobotAndTheFirst() {
    Bench b({QStringLiteral("Robot 1"), QStringLiteral("B2")});
    PlotPane* pane = b.show(expression(QStringLiteral("each.DIST * 2 + each.ANGLE")));
    QCOMPARE(namesOf(pane), QStringList({QStringLiteral("DIST * 2 + ANGLE Robot 1"),
                                         QStringLiteral("DIST * 2 + ANGLE B2")}));
    const double expected = PlotSource::distanceAt(10.0) * 2 + 900.0;
    QTRY_VERIFY(pane->curves()[0].valueAt({}) && pane->curves()[1].valueAt({}));
    QTRY_COMPARE(pane->curves()[0].valueAt(10.0), std::optional(expected));
    PlotPane* first = b.show(variableCurve(QStringLiteral("first/DIST")));
    QCOMPARE(namesOf(first), QStringList(QStringLiteral("DIST Robot 1")));
    // From a plain curve by the menu's way.
    QCOMPARE(forEachGroup(variableCurve(QStringLiteral("B2/DIST"))).inputs,
             QStringList(QStringLiteral("each/DIST")));
  }

  /// The plotted curve redrew itself with another robot's past when the referee's operator
  /// corrected the colours.
  void aCurveStaysThatOfItsRobot() {
    Bench b(QStringList{});
    const auto named = [](const char* id, const char* name) {
      telemetry::GroupInfo info;
      info.id = id;
      info.name = name;
      telemetry::ColumnInfo column;
      column.name = "DIST";
      info.columns = {column};
      return info;
    };
    std::map<std::string, telemetry::GroupId> groups;
    int sent = 0;
    const auto rows = [&](int count) {
      for (int i = 0; i < count; ++i) {
        const double time = 0.1 * sent++;  // a sum of tenths would be a little later than 2.0
        for (const auto& [id, group] : groups) {
          const double value = id == "1" ? 100.0 + i : 700.0 + i;
          b.source.store->append(group, {time, {}, std::span(&value, 1)});
        }
      }
      b.dock->feed()->refresh();
    };
    groups["1"] = b.source.store->addGroup(named("1", "B1"));
    groups["2"] = b.source.store->addGroup(named("2", "R1"));
    rows(50);
    PaneSpec chart;
    CurveSpec derived;
    derived.kind = CurveKind::Derivative;
    derived.inputs << QStringLiteral("B1/DIST");
    CurveSpec hidden = variableCurve(QStringLiteral("R1/DIST"));
    hidden.hidden << QStringLiteral("DIST R1");
    chart.curves = {variableCurve(QStringLiteral("B1/DIST")), hidden,
                    expression(QStringLiteral("B1.DIST - {R1/DIST}")), derived,
                    expression(QStringLiteral("{curve/d/dt DIST B1} * 2"))};
    b.dock->setLayoutSpec({{PageSpec{QStringLiteral("one"), {chart}}}, 0});
    const auto pane = [&b] { return b.dock->currentPage()->panes()[0]; };
    const auto drawn = [&](double first, double second, double difference) {
      b.dock->feed()->refresh();
      pane()->refresh();
      const auto& curves = pane()->curves();
      return curves[0].valueAt(2.0) == first && curves[1].valueAt(2.0) == second &&
             curves[2].valueAt(2.0) == difference;
    };
    QTRY_VERIFY(drawn(120.0, 720.0, -600.0));
    // Corrected, corrected back, and again: with rows in between.
    for (int swap = 0; swap < 3; ++swap) {
      const bool isSwapped = swap % 2 == 0;
      b.source.store->describeGroups(
          std::array{named("1", isSwapped ? "R1" : "B1"), named("2", isSwapped ? "B1" : "R1")});
      rows(10);
      const QString ours = isSwapped ? QStringLiteral("R1") : QStringLiteral("B1");
      const QString theirs = isSwapped ? QStringLiteral("B1") : QStringLiteral("R1");
      QTRY_VERIFY(drawn(120.0, 720.0, -600.0));
      QCOMPARE(pane()->curves()[0].name(), QStringLiteral("DIST ") + ours);
      QVERIFY(!pane()->curves()[0].isHidden() && pane()->curves()[1].isHidden());
      QCOMPARE(namesOf(pane()).value(3), QStringLiteral("d/dt DIST ") + ours);
      QVERIFY(!pane()->curves()[4].isFaulty());
      const QList<CurveSpec> kept = b.dock->layoutSpec().pages[0].panes[0].curves;
      QCOMPARE(kept[0].inputs, QStringList(ours + QStringLiteral("/DIST")));
      QCOMPARE(kept[2].expression, QStringLiteral("%1.DIST - %2.DIST").arg(ours, theirs));
      QCOMPARE(kept[4].expression, QStringLiteral("{curve/d/dt DIST %1} * 2").arg(ours));
    }
    // What is dragged there now is the robot that has the name now, and an undone change comes back
    // with its own robot.
    pane()->addCurve(variableCurve(QStringLiteral("B1/DIST")));
    QCOMPARE(pane()->curves().size(), std::size_t(5));  // it is there already
    pane()->removeCurve(0);
    b.source.store->describeGroups(std::array{named("1", "B1"), named("2", "R1")});
    rows(1);
    b.dock->undoStack()->undo();
    QTRY_VERIFY(pane()->curves().size() == 5 && drawn(120.0, 720.0, -600.0));
    QCOMPARE(pane()->curves()[0].name(), QStringLiteral("DIST B1"));
  }

  void curvesAreMadeOfCurves() {
    Bench b;
    CurveSpec near = expression(QStringLiteral("B1.DIST / 100"));
    near.title = QStringLiteral("near");
    b.show(near);
    PlotPane* pane = b.show(expression(QStringLiteral("{curve/near} + B1.ANGLE")));
    const double expected = PlotSource::distanceAt(10.0) / 100 + 900.0;
    // Two computations, one after the other, each by a worker between two looks of the plots: a
    // busy computer takes its time.
    const auto hasText = [pane](double value) {
      const auto at = pane->curves()[0].valueAt(10.0);
      return at && std::abs(*at - value) < 1e-9;
    };
    QTRY_VERIFY_WITH_TIMEOUT(hasText(expected), 60'000);
    // What it is made of changes: so does it.
    PlotPane* source = b.dock->currentPage()->panes()[1];
    near.expression = QStringLiteral("B1.DIST / 10");
    source->setCurve(0, near);
    const double now = PlotSource::distanceAt(10.0) / 10 + 900.0;
    QTRY_VERIFY_WITH_TIMEOUT(hasText(now), 60'000);
    // A curve that is made of itself waits for ever and harms nobody.
    CurveSpec circle = expression(QStringLiteral("{curve/circle} + B1.DIST"));
    circle.title = QStringLiteral("circle");
    PlotPane* endless = b.show(circle);
    b.dock->feed()->refresh();
    QVERIFY(endless->curves()[0].isWaiting());
  }

  /// What was computed is not computed again: rows that came before are not looked at any more.
  void onlyWhatIsNewIsComputed() {
    PlotSource first, other;
    first.fill("B1", 10.0);
    // The same near 10 s and behind it, another one before: who computes that again gives it away.
    constexpr double changed = 8.0, elsewhere = -1e6;
    const auto group = other.addRobot("B1");
    for (int i = 0; i <= 900; ++i) {
      const double time = i / 60.0;
      other.append(group, time, 0, time < changed ? elsewhere : PlotSource::distanceAt(time));
    }
    DerivedSeries series(expression(QStringLiteral("B1.DIST * 2")));
    const PlotSource* source = &first;
    const auto find = [&source](const QString&) { return ColumnView{source->store->view(0), 1}; };
    const auto finish = [&](quint64 generation) {
      series.update(find, generation, {0.0, 15.0});
      return !series.isWorking();
    };
    const auto values = [&series] {
      std::vector<telemetry::Sample> samples;
      const ColumnView view = series.view();
      if (view) view.group->samples(view.column, {-1.0, 100.0}, samples);
      return samples;
    };
    QTRY_VERIFY(finish(1));
    QCOMPARE(values().size(), std::size_t(601));
    source = &other;
    QTRY_VERIFY(finish(1));
    QCOMPARE(values().size(), std::size_t(901));
    for (const telemetry::Sample& sample : values()) {
      QCOMPARE(sample.value, 2 * PlotSource::distanceAt(sample.time));
    }
    // Of another match nothing holds.
    QTRY_VERIFY(finish(2));
    QCOMPARE(values().size(), std::size_t(901));
    for (const telemetry::Sample& sample : values()) {
      QCOMPARE(sample.value,
               2 * (sample.time < changed ? elsewhere : PlotSource::distanceAt(sample.time)));
    }
  }

  /// The value of another robot holds until the robot was silent for 10 s, as in questions about
  /// sessions; then it is unknown, as what is computed with it.
  void aSilentRobotIsUnknown() {
    PlotSource source;
    source.fill("B1", 30.0);
    const auto other = source.addRobot("B2");
    source.append(other, 5.0, 0, 40.0);
    source.append(other, 25.0, 0, 50.0);
    DerivedSeries series(expression(QStringLiteral("B1.DIST * 0 + B2.DIST")));
    const auto find = [&source](const QString& name) {
      return ColumnView{source.store->view(name.startsWith(QStringLiteral("B1")) ? 0 : 1), 1};
    };
    QTRY_VERIFY((series.update(find, 1, {0.0, 30.0}), !series.isWorking()));
    const ColumnView view = series.view();
    const auto at = [&view](double time) { return view.group->at(view.column, time)->value; };
    QVERIFY(std::isnan(at(4.0)));
    QCOMPARE(at(6.0), 40.0);
    QCOMPARE(at(14.9), 40.0);
    QVERIFY(std::isnan(at(15.1)));
    QVERIFY(std::isnan(at(24.9)));
    QCOMPARE(at(25.1), 50.0);
    QCOMPARE(at(30.0), 50.0);
  }

  /// A layout of "Robot 1" shows that robot after the referee has told its colour.
  void aRobotIsFoundByAFormerName() {
    Bench b(QStringList{});
    std::uint32_t uid = 0;
    const auto add = [&](const char* name, const char* former) {
      telemetry::GroupInfo info;
      info.name = name;
      info.id = std::to_string(++uid);
      telemetry::RobotFacts& facts = info.robot.emplace();
      facts.uid = {uid};
      facts.formerNames = {former};
      info.columns.resize(1);
      info.columns[0].name = "DIST";
      const auto group = b.source.store->addGroup(info);
      for (const double time : {0.0, 20.0}) {
        const double value = uid;
        b.source.store->append(group, {time, {}, {&value, 1}});
      }
    };
    add("B1", "Robot 1");
    add("R2", "Robot 2");
    add("B2", "Robot 2");
    const PlotPane* pane = b.show(variableCurve(QStringLiteral("Robot 1/DIST")));
    QCOMPARE(namesOf(pane), QStringList(QStringLiteral("DIST B1")));
    QTRY_COMPARE(pane->curves()[0].valueAt(10.0), std::optional(1.0));
    // Two were called so, one of which is B2 now.
    QCOMPARE(namesOf(b.show(variableCurve(QStringLiteral("Robot 2/DIST")))),
             QStringList(QStringLiteral("DIST Robot 2")));
    // A name is nobody's only because the number is the same.
    QCOMPARE(namesOf(b.show(variableCurve(QStringLiteral("R1/DIST")))),
             QStringList(QStringLiteral("DIST R1")));
  }

  void theFirstRobotIsOneThatMoves() {
    PlotBench bench;
    const auto still = bench.source.addRobot("B1"), moving = bench.source.addRobot("B2");
    PlotsDock dock(bench.context(), nullptr);
    dock.resize(800, 300);
    dock.show();
    PaneSpec chart, lane;
    chart.curves << variableCurve(QStringLiteral("first/DIST"));
    lane.kind = PaneKind::Lane;
    lane.curves << variableCurve(QStringLiteral("first/ACTION"));
    dock.setLayoutSpec({{{QStringLiteral("one"), {chart, lane}}}, 0});
    const auto shown = [&] {
      QStringList names;
      for (const PlotPane* pane : dock.currentPage()->panes()) names << namesOf(pane);
      return names;
    };
    const auto play = [&](double from, double to, bool moves) {
      for (double time = from; time < to; time += 0.1) {
        bench.source.append(still, time, 0, 7.0);
        bench.source.append(moving, time, 0, moves ? 100.0 + time : 5.0);
      }
    };
    play(0.0, 10.0, false);
    QTRY_COMPARE(shown(), QStringList({QStringLiteral("DIST B1"), QStringLiteral("ACTION B1")}));
    play(10.0, 11.0, true);
    QTRY_COMPARE(shown(), QStringList({QStringLiteral("DIST B2"), QStringLiteral("ACTION B2")}));
    // It stays that one, though it rests and the other begins.
    for (double time = 11.0; time < 30.0; time += 0.1) {
      bench.source.append(still, time, 0, time);
      bench.source.append(moving, time, 0, 3.0);
    }
    QTRY_COMPARE(dock.time()->data()->end, bench.source.store->range()->end);
    dock.feed()->refresh();
    QCOMPARE(shown().front(), QStringLiteral("DIST B2"));
  }

  void theFirstRobotIsOursAtTheBall() {
    PlotBench bench;
    auto frame = std::make_shared<link::MatchFrame>();
    frame->teams = {{}, {12, "RoboFEI", TeamColor::Blue, true}, {7, "", TeamColor::Red, false}};
    frame->snapshot.ball = {1.0, 0.0};
    const auto add = [&](const char* name, const RobotKey& key, double x, const char* behaviour) {
      link::RobotFrame& robot = frame->robots.emplace_back();
      robot.name = name;
      robot.key = key;
      robot.pose.position = {x, 0.0};
      robot.behaviour = behaviour;
      bench.source.fill(name, 10.0);
    };
    add("B1", {1, 1, 0}, -3.0, "striker");
    add("B2", {1, 2, 0}, 0.9, "keeper");
    add("B3", {1, 3, 0}, 0.5, "supporter");
    add("R1", {2, 1, 0}, 1.0, "striker");
    bench.source.shown = frame;
    PlotsDock dock(bench.context(), nullptr);
    dock.resize(800, 300);
    dock.show();
    PaneSpec chart;
    chart.curves << variableCurve(QStringLiteral("first/DIST"));
    dock.setLayoutSpec({{{QStringLiteral("one"), {chart}}}, 0});
    dock.feed()->refresh();
    QTRY_COMPARE(namesOf(dock.currentPage()->panes()[0]), QStringList(QStringLiteral("DIST B3")));
  }

  // Nobody is ours in a simulated match.
  void theFirstRobotOfAMatchIsOfTheFirstTeam() {
    PlotBench bench;
    auto frame = std::make_shared<link::MatchFrame>();
    for (const auto& [name, team, x] :
         {std::tuple("B1", 0, -3.0), std::tuple("B2", 0, -1.0), std::tuple("R1", 1, 0.1)}) {
      link::RobotFrame& robot = frame->robots.emplace_back();
      robot.name = name;
      robot.key = {team, name[1] - '0', 0};
      robot.pose.position = {x, 0.0};
      bench.source.fill(name, 10.0);
    }
    PlotsDock dock(bench.context(), nullptr);
    dock.resize(800, 300);
    dock.show();
    PaneSpec chart;
    chart.curves << variableCurve(QStringLiteral("first/DIST"));
    dock.setLayoutSpec({{{QStringLiteral("one"), {chart}}}, 0});
    // Chosen before a frame says where the robots are, and whose they are.
    dock.feed()->refresh();
    QTRY_VERIFY(!namesOf(dock.currentPage()->panes()[0]).isEmpty());
    bench.source.shown = frame;
    emit bench.source.restarted();
    dock.feed()->refresh();
    const auto shownName = [&dock] { return namesOf(dock.currentPage()->panes()[0]); };
    QTRY_COMPARE(shownName(), QStringList(QStringLiteral("DIST B2")));
    // It is still that robot's when the match is shown again after a recording without robots,
    // although another one is at the ball now.
    const auto match = bench.source.store;
    bench.source.shown = std::make_shared<link::MatchFrame>();
    bench.source.restart();
    dock.feed()->refresh();
    auto later = std::make_shared<link::MatchFrame>(*frame);
    later->robots[0].pose.position = {0.0, 0.0};
    bench.source.shown = later;
    bench.source.store = match;
    emit bench.source.restarted();
    dock.feed()->refresh();
    QTRY_COMPARE(shownName(), QStringList(QStringLiteral("DIST B2")));
  }

  // Received before ours, a guest was the first plot, and stayed it.
  void ourFirstRobotReplacesGuests() {
    PlotBench bench;
    const auto frameOf = [](const std::vector<std::pair<const char*, RobotKey>>& robots) {
      auto frame = std::make_shared<link::MatchFrame>();
      frame->teams = {{}, {12, "RoboFEI", TeamColor::Blue, true}, {7, "", TeamColor::Red, false}};
      for (const auto& [name, key] : robots) {
        link::RobotFrame& robot = frame->robots.emplace_back();
        robot.name = name;
        robot.key = key;
      }
      return frame;
    };
    const auto guest = bench.source.addRobot("R1");
    bench.source.shown = frameOf({{"R1", {2, 1, 0}}});
    PlotsDock dock(bench.context(), nullptr);
    dock.resize(800, 300);
    dock.show();
    PaneSpec chart;
    chart.curves << variableCurve(QStringLiteral("first/DIST"));
    dock.setLayoutSpec({{{QStringLiteral("one"), {chart}}}, 0});
    for (double time = 0.0; time < 5.0; time += 0.1) bench.source.append(guest, time, 0, time);
    dock.feed()->refresh();
    QTRY_COMPARE(namesOf(dock.currentPage()->panes()[0]), QStringList(QStringLiteral("DIST R1")));
    const auto ours = bench.source.addRobot("B2");
    bench.source.shown = frameOf({{"R1", {2, 1, 0}}, {"B2", {1, 2, 0}}});
    for (double time = 5.0; time < 8.0; time += 0.1) {
      bench.source.append(guest, time, 0, time);
      bench.source.append(ours, time, 0, 2.0 * time);
    }
    dock.feed()->refresh();
    QTRY_COMPARE(namesOf(dock.currentPage()->panes()[0]), QStringList(QStringLiteral("DIST B2")));
  }

  void namesAreCompletedInExpressions() {
    Bench b({QStringLiteral("B1"), QStringLiteral("Robot 7")});
    CurveDialog dialog(b.dock->feed(), expression({}), nullptr);
    dialog.show();
    auto* line = dialog.findChild<QLineEdit*>(QStringLiteral("expression"));
    auto* completer = line->findChild<QCompleter*>(QStringLiteral("expressionCompleter"));
    line->setFocus();
    QTest::keyClicks(line, QStringLiteral("2 * angl"));
    QCOMPARE(completer->completionCount(), 4);  // of both robots, each and first
    emit completer->activated(completer->currentCompletion());
    QCOMPARE(line->text(), QStringLiteral("2 * B1.ANGLE"));
    QVERIFY2(dialog.problem().isEmpty(), qPrintable(dialog.problem()));
    QTest::keyClicks(line, QStringLiteral(" + dist"));
    completer->setCurrentRow(1);
    emit completer->activated(completer->currentCompletion());
    QCOMPARE(line->text(), QStringLiteral("2 * B1.ANGLE + {Robot 7/DIST}"));
    QVERIFY2(dialog.problem().isEmpty(), qPrintable(dialog.problem()));
  }

  void eachAndFirstAreCompleted() {
    Bench b({QStringLiteral("B1"), QStringLiteral("B2")});
    b.source.store->addGroup(
        {"B3", {{"ALONE", telemetry::ColumnType::Float64, "", "", {}, {}}}, {}});
    b.dock->feed()->refresh();
    CurveDialog dialog(b.dock->feed(), expression({}), nullptr);
    dialog.show();
    auto* line = dialog.findChild<QLineEdit*>(QStringLiteral("expression"));
    auto* completer = line->findChild<QCompleter*>(QStringLiteral("expressionCompleter"));
    const auto offered = [&](const QString& word) {
      line->clear();
      line->setFocus();
      QTest::keyClicks(line, word);
      QStringList all;
      for (int i = 0; i < completer->completionModel()->rowCount(); ++i) {
        all << completer->completionModel()->index(i, 0).data().toString();
      }
      return all;
    };
    QVERIFY(offered(QStringLiteral("each.di")).contains(QStringLiteral("each.DIST")));
    QVERIFY(offered(QStringLiteral("first.di")).contains(QStringLiteral("first.DIST")));
    // One robot has it: "each" would be that one.
    QCOMPARE(offered(QStringLiteral("alone")),
             QStringList({QStringLiteral("B3.ALONE"), QStringLiteral("first.ALONE")}));
  }

  void anUnknownVariableIsNamed() {
    Bench b;
    CurveDialog dialog(b.dock->feed(), expression({}), nullptr);
    auto* line = dialog.findChild<QLineEdit*>(QStringLiteral("expression"));
    auto* problem = dialog.findChild<QLabel*>(QStringLiteral("problem"));
    auto* ok = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
    line->setText(QStringLiteral("B1.DISTANCE * 2"));
    QCOMPARE(problem->text(), QStringLiteral("B1 has no variable DISTANCE. Did you mean DIST?"));
    QVERIFY(ok->isEnabled());  // it may come
    line->setText(QStringLiteral("B1.XYZQVW * 2"));
    QCOMPARE(problem->text(), QStringLiteral("B1 has no variable XYZQVW."));
    line->setText(QStringLiteral("B7.DIST"));
    QCOMPARE(problem->text(), QStringLiteral("There is no B7. Did you mean B1?"));
    line->setText(QStringLiteral("each.DIST + first.ANGLE - t"));
    QCOMPARE(problem->text(), QString());
  }
};

PITCHBOARD_GUI_TEST(TestPlotVariables)

}  // namespace tst_plot_variables

#include "tst_plot_variables.moc"
