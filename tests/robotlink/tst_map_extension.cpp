// SPDX-License-Identifier: GPL-3.0-or-later
// The extension of the variable map: sight of eleven against eleven, and what decision and planning
// tell each other.
#include <QtTest>

#include <cmath>
#include <limits>
#include <numbers>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/match/simulated_match.h>
#include <simcore/world/published_frame.h>

#include "planning/target.h"

namespace tst_map_extension {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr int robots = 22;
constexpr std::uint32_t mark = 0x00C0FFEE;

int wordOf(const Variable& variable) {
  return variable.index + (variable.type == VariableType::Float ? Blackboard::floatOffset : 0);
}

Blackboard marked() {
  Blackboard board = Blackboard::onHeap();
  for (int word = 0; word < Blackboard::words; ++word) {
    board.write(IntVar{word}, static_cast<int>(mark));
  }
  return board;
}

std::array<std::uint32_t, Blackboard::words> wordsOf(const Blackboard& board) {
  std::array<std::uint32_t, Blackboard::words> words{};
  board.copyWords(words);
  return words;
}

/// Places for 21 robots, all within 30° and 3 m of the front of one that stands at the origin.
std::vector<Point> crowd() {
  std::vector<Point> places;
  for (const double radius : {1.3, 1.7, 2.1, 2.5, 2.9}) {
    const int inRow = static_cast<int>(radius / 0.4);
    for (int i = 0; i < inRow; ++i) {
      const double angle = (i - (inRow - 1) / 2.0) * 0.32 / radius;
      places.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  return places;
}

float valueOf(const Blackboard& board, const QString& name) {
  return board.read(VariableCatalog::extended().floatVar(name.toStdString()).value());
}

QString slot(int number, const char* what) {
  return QString("VISION_RBT%1_%2").arg(number, 2, 10, QChar('0')).arg(what);
}

Target to(const Pose& pose) {
  Target target;
  target.pose = pose;
  return target;
}

struct Planner {
  Planner() : process(findProcess("planning")->make(ProcessOptions{}).value()) {
    variables.write(board, field, {});
    variables.clear(board);
    setPose({{0, 0}, 0});
  }
  void setPose(const Pose& pose) {
    const auto cm = sim::published_frame::localizationFromStudio(field, pose);
    const RobotVariables v;
    board.write(v.localizationX, static_cast<int>(std::lround(cm.x)));
    board.write(v.localizationY, static_cast<int>(std::lround(cm.y)));
    board.write(v.localizationTheta, static_cast<int>(std::lround(cm.degrees)));
  }
  int actionAfter(const Target& target) {
    variables.write(board, field, target);
    process->step(board, {now += 0.1});
    return board.read(RobotVariables().decisionActionA);
  }
  int pathPoints() const {
    return board.read(*VariableCatalog::extended().intVar("PLANNING_PATH_POINTS"));
  }

  sim::FieldSpec field = ProcessOptions{}.field;
  Blackboard board = Blackboard::onHeap();
  TargetVariables variables;
  std::unique_ptr<CognitiveProcess> process;
  double now = 0.0;
};

}  // namespace

class TestMapExtension : public QObject {
  Q_OBJECT
 private slots:
  // Unchanged programs do not see it: the published map ends at word 247, ints at 107.
  void itLiesBeyondThePublishedMap() {
    const auto& all = VariableCatalog::extended().variables();
    int more = 0;
    for (const Variable& variable : all) {
      if (VariableCatalog::published().find(variable.name)) continue;
      ++more;
      QVERIFY2(wordOf(variable) >= 384, variable.name.c_str());
    }
    QCOMPARE(static_cast<int>(VariableCatalog::published().variables().size()), 205);
    QCOMPARE(more, 75);
  }

  void variablesOfATeamAreNotOverwritten() {
    const auto map = VariableCatalog::fromJson(
        R"({"int": {"OURS": 384, "PLANNING_PATH_POINTS": 9}, "float": {"VISION_RBT13_DIST": 3}})",
        "team");
    const VariableCatalog all = map->withExtension();
    QVERIFY(!all.find("VISION_RBT12_DIST"));  // word 384
    QCOMPARE(all.find("VISION_RBT13_DIST")->index, 3);
    QCOMPARE(all.find("PLANNING_PATH_POINTS")->index, 9);
    QCOMPARE(all.find("VISION_RBT14_DIST")->index, 261);
    QCOMPARE(RobotVariables(all).robotDist[13].index, 261);
  }

  // 22 x 21 sights against distances and angles worked out from where everybody stands.
  void everyRobotSeesEveryOtherInView_data() {
    QTest::addColumn<bool>("mates");
    QTest::newRow("team-mates") << true;
    QTest::newRow("opponents") << false;
  }
  void everyRobotSeesEveryOtherInView() {
    QFETCH(bool, mates);
    const std::vector<Point> places = crowd();
    QVERIFY(places.size() >= robots - 1);
    const BlackboardBridge bridge{RobotVariables(VariableCatalog::extended())};
    int seen = 0;
    for (int observer = 0; observer < robots; ++observer) {
      sim::SimulationSettings settings;
      auto simulation = sim::Simulation::create(settings).value();
      std::vector<Point> stands(robots);
      for (int i = 0, next = 0; i < robots; ++i) {
        const auto index = static_cast<std::size_t>(i);
        if (i != observer) stands[index] = places[static_cast<std::size_t>(next++)];
        const auto team = i < robots / 2 ? TeamColor::Blue : TeamColor::Red;
        QVERIFY(
            simulation.addRobot({RobotId{i + 1}, team, i % 11 + 1, false}, {stands[index], 0.0}));
      }
      std::vector<sim::RobotCommand> commands(robots);
      std::vector<sim::Percepts> percepts(robots);
      commands[static_cast<std::size_t>(observer)].searchOn = 0;
      commands[static_cast<std::size_t>(observer)].actionVision = mates ? 1 : 2;
      simulation.step(commands, percepts);
      Blackboard board = Blackboard::onHeap();
      bridge.publish(percepts[static_cast<std::size_t>(observer)], board);
      for (int other = 0; other < robots; ++other) {
        const bool mate = (other < robots / 2) == (observer < robots / 2);
        const bool wanted = other != observer && mate == mates;
        const Point at = stands[static_cast<std::size_t>(other)];
        const double distance_cm = wanted ? 100 * std::hypot(at.x, at.y) : 0.0;
        const double right_deg = wanted ? -std::atan2(at.y, at.x) * 180 / std::numbers::pi : 0.0;
        const QByteArray who = QString("%1 of %2").arg(other + 1).arg(observer + 1).toUtf8();
        QVERIFY2(std::abs(double(valueOf(board, slot(other + 1, "DIST"))) - distance_cm) < 1e-3,
                 who);
        QVERIFY2(std::abs(double(valueOf(board, slot(other + 1, "ANGLE"))) - right_deg) < 1e-3,
                 who);
        seen += wanted;
      }
    }
    QCOMPARE(seen, mates ? robots * 10 : robots * 11);
  }

  // A program that knows the published map only: nothing beyond it is written.
  void withoutTheExtensionNothingIsWrittenThere() {
    sim::Percepts percepts;
    for (auto& robot : percepts.robots) robot = sim::SeenRobot{100.0, 5.0};
    Blackboard board = marked();
    BlackboardBridge{RobotVariables()}.publish(percepts, board);
    const auto words = wordsOf(board);
    for (std::size_t word = 248; word < words.size(); ++word) QCOMPARE(words[word], mark);
  }

  // In a whole match: blue robots, whose opponents are the 12th to the 22nd of the field, know
  // where those stand that they have seen.
  void elevenAgainstElevenKnowEachOther() {
    Scenario scenario = loadScenario("match-11v11").value();
    scenario.settings.noise = {};
    MatchOptions options;
    options.process.particles = 200;
    auto match = SimulatedMatch::create(scenario, options).value();
    const VariableCatalog& map = VariableCatalog::published();
    int known = 0;
    for (int tick = 0; tick < 60 * 60; ++tick) {
      match.tick();
      if (tick % 60 != 59 || tick < 20 * 60) continue;
      const sim::Snapshot now = match.simulation().snapshot();
      for (std::size_t i = 0; i < 11; ++i) {
        const Blackboard& board = *match.blackboard(now.robots[i].identity.id);
        const double x = double(board.read(*map.floatVar("LOCALIZATION_OPP01_X")));
        const double y = double(board.read(*map.floatVar("LOCALIZATION_OPP01_Y")));
        if (x < 0) continue;
        const Point reported =
            sim::published_frame::studioFromLocalization(scenario.settings.field, {x, y, 0})
                .position;
        double nearest = 1e9;
        for (std::size_t other = 11; other < now.robots.size(); ++other) {
          nearest = std::min(nearest, distance(reported, now.robots[other].pose.position));
        }
        known += nearest < 0.7;
      }
    }
    qInfo("opponents known %d times", known);
    QVERIFY(known > 50);
  }

  void planningWalksToTheTarget() {
    Planner p;
    QCOMPARE(p.actionAfter(to({{2, 0}, 0})), 1);  // ahead: forward
    QCOMPARE(p.actionAfter(to({{0, 2}, 0})), 6);  // beside it, same heading: sideways
    QCOMPARE(p.actionAfter(to({{0, 2}, std::numbers::pi / 2})), 2);  // to look there: turns left
    QCOMPARE(p.actionAfter(to({{-2, 0}, 0})), 17);                   // behind it: backward
    QCOMPARE(p.actionAfter(to({{0.02, 0}, 1.0})), 2);                // there, but looks elsewhere
    QCOMPARE(p.actionAfter(to({{0.02, 0}, 0.1})), 0);                // there
    QCOMPARE(p.pathPoints(), 0);
  }

  void planningWalksAroundObstacles() {
    Planner p;
    const VariableCatalog& map = VariableCatalog::published();
    const auto inTheWay = [&](const char* variable) {
      const auto cm = sim::published_frame::localizationFromStudio(p.field, {{1, 0}, 0});
      p.board.write(*map.floatVar(std::string(variable) + "_X"), static_cast<float>(cm.x));
      p.board.write(*map.floatVar(std::string(variable) + "_Y"), static_cast<float>(cm.y));
      p.now += 1;
      (void)p.actionAfter(to({{2, 0}, 0}));
      const int points = p.pathPoints();
      const double bendY =
          double(valueOf(p.board, "PLANNING_PATH01_Y")) - 100 * p.field.halfWidth();
      p.board.write(*map.floatVar(std::string(variable) + "_X"), -1.0F);
      p.board.write(*map.floatVar(std::string(variable) + "_Y"), -1.0F);
      return points > 1 && std::abs(bendY) > 100 * p.field.robotRadius;
    };
    QVERIFY(!inTheWay("LOCALIZATION_RBT01"));  // its Y is nobody's: the belief's neighbour
    QVERIFY(inTheWay("LOCALIZATION_RBT02"));
    QVERIFY(inTheWay("LOCALIZATION_RBT11"));
    QVERIFY(inTheWay("LOCALIZATION_OPP01"));
    QVERIFY(inTheWay("LOCALIZATION_OPP11"));
    p.now += 1;
    (void)p.actionAfter({{{2, 0}, 0}, 0.1, 0.2, Point{1, 0}});
    QVERIFY(p.pathPoints() > 1);  // the ball
    p.now += 1;
    (void)p.actionAfter(to({{2, 0}, 0}));
    QCOMPARE(p.pathPoints(), 1);
  }

  // Where decision acts by itself, planning touches nothing, whatever stands on the blackboard.
  void withoutATargetPlanningWritesNothing() {
    Planner p;
    p.board = marked();
    const int target = VariableCatalog::extended().intVar("DECISION_TARGET")->index;
    for (const int value : {0, -1, 3, static_cast<int>(mark)}) {
      p.board.write(IntVar{target}, value);
      const auto before = wordsOf(p.board);
      p.process->step(p.board, {1.0});
      QVERIFY(wordsOf(p.board) == before);
    }
    // Numbers that make no sense are no target.
    p.board.write(IntVar{target}, 1);
    p.board.write(*VariableCatalog::extended().floatVar("DECISION_TARGET_X"),
                  std::numeric_limits<float>::quiet_NaN());
    const auto before = wordsOf(p.board);
    p.process->step(p.board, {2.0});
    QVERIFY(wordsOf(p.board) == before);
  }

  // Decision tells where, planning acts: without planning the action stays as it was.
  void decisionLeavesPathsToPlanning() {
    ProcessOptions options;
    options.behaviour = "striker";
    options.facesLeft = false;
    const auto decision = findProcess("decision")->make(options).value();
    Planner p;
    const RobotVariables v;
    p.setPose({{-3, 1}, 0});
    p.board.write(v.localizationBelief, 5.0F);
    p.board.write(v.comReferee, 11);  // ready: to its place for the kick-off
    p.board.write(v.decisionActionA, 11);
    decision->step(p.board, {0.1});
    QCOMPARE(p.board.read(v.decisionActionA), 11);
    const auto target = p.variables.read(p.board, p.field);
    QVERIFY(target.has_value());
    QVERIFY(distance(target->pose.position, {-0.5 * p.field.centreCircleDiameter - 0.35, 0.0}) <
            1e-6);
    p.process->step(p.board, {0.1});
    QVERIFY(p.board.read(v.decisionActionA) != 11);
    QVERIFY(p.pathPoints() >= 1);
    CognitionDebug cognitionDebug;
    p.process->sendDebugData(cognitionDebug);
    QVERIFY(cognitionDebug.path && cognitionDebug.path->points.size() >= 2);
    p.board.write(v.comReferee, 1);
    decision->step(p.board, {0.2});
    QCOMPARE(p.board.read(v.decisionActionA), 0);
    QVERIFY(!p.variables.read(p.board, p.field));
    p.process->step(p.board, {0.2});
    QCOMPARE(p.board.read(v.decisionActionA), 0);
    QCOMPARE(p.pathPoints(), 0);
  }
};

PITCHBOARD_TEST(TestMapExtension)

}  // namespace tst_map_extension

#include "tst_map_extension.moc"
