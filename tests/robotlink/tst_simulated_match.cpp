// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include <random>
#include <set>

#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/game_start.h>

#include "../support/allocation_counter.h"
#include "../support/segment_keys.h"

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Scenario builtIn(const char* name) {
  return loadScenario(name).value();
}

SimulatedMatch make(const Scenario& scenario, const MatchOptions& options = {}) {
  auto match = SimulatedMatch::create(scenario, options);
  if (!match) qFatal("%s", match.error().text().c_str());
  return std::move(*match);
}

MatchOptions shared(Cognition cognition) {
  MatchOptions options;
  options.cognition = cognition;
  options.keyBase = testKeyBase();
  options.robotProgram = "/bin/false-pitchboard";
  return options;
}

/// Two halves of two minutes by these rules, four against four.
Scenario shortMatch(const QString& rules) {
  Scenario scenario = builtIn("match");
  sim::RefereeRules& set = scenario.settings.referee.emplace();
  set = refereeRuleSet(rules.toStdString()).value().value();
  set.halfTime = 120;
  set.breakTime = 10;
  set.readyTime = 20;
  scenario.stop = {};
  return scenario;
}

void ruleSets() {
  QTest::addColumn<QString>("rules");
  for (const char* rules : {"humanoid-2014", "humanoid-2021", "humanoid-soccer-2026"}) {
    QTest::newRow(rules) << rules;
  }
}

BlackboardWrite writeAt(double time, int robot, const char* variable, double value) {
  return {RobotId{robot}, variable, value, time};
}

}  // namespace

class TestSimulatedMatch : public QObject {
  Q_OBJECT

 private slots:
  void theSameSeedGivesTheSameHash() {
    for (const auto& [name, title] : builtInScenarios()) {
      auto first = make(builtIn(name.c_str()));
      auto second = make(builtIn(name.c_str()));
      for (int i = 0; i < 600; ++i) {
        first.tick();
        second.tick();
      }
      QCOMPARE(first.simulation().hash(), second.simulation().hash());
    }
  }

  void aRobotWithTheNaiveBehaviourKicksTheBall() {
    Scenario scenario = builtIn("one-robot");
    scenario.robots[0].behaviour = "naive";
    auto match = make(scenario);
    for (int i = 0; i < 60 * 60; ++i) match.tick();
    QVERIFY(match.simulation().snapshot().robots[0].statistics.kicks > 0);
  }

  void noAllocationPerTickAfterTheStart() {
    if (!countsAllocations) QSKIP("the sanitizer has its own allocation functions");
    // Engine, bridge and the naive behaviour; planning a path and talking to the team may allocate.
    Scenario scenario = builtIn("match-3v3");
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = "naive";
    auto match = make(scenario);
    for (int i = 0; i < 120; ++i) match.tick();
    const long before = allocations;
    for (int i = 0; i < 3000; ++i) match.tick();
    QCOMPARE(allocations - before, 0L);
    QVERIFY(theCounterCounts());
  }

  void scriptedWritesHappenBeforeTheirTick() {
    Scenario scenario = builtIn("one-robot");
    scenario.robots[0].behaviour = std::string(noBehaviour);
    scenario.writes = {writeAt(0, 0, "DECISION_ACTION_B", 3),
                       writeAt(0.5, 1, "DECISION_ACTION_A", 2), writeAt(0.5, 1, "IMU_STATE", 0)};
    auto match = make(scenario);
    const RobotVariables& v = match.variables();
    QCOMPARE(match.blackboard(RobotId{1})->read(v.decisionActionB), 3);
    for (int i = 0; i < 30; ++i) match.tick();
    QCOMPARE(match.blackboard(RobotId{1})->read(v.decisionActionA), 0);
    match.tick();  // begins at 0.5 s
    QCOMPARE(match.blackboard(RobotId{1})->read(v.decisionActionA), 2);
    QCOMPARE(match.blackboard(RobotId{1})->read(v.controlAction), 2);
  }

  void aWriteInTheMiddleOfATickWaitsForTheNext() {
    Scenario scenario = builtIn("one-robot");
    scenario.writes = {writeAt(0.51, 0, "DECISION_ACTION_VISION", 2)};
    auto match = make(scenario);
    const IntVar look = match.variables().decisionActionVision;
    for (int i = 0; i < 31; ++i) match.tick();
    QCOMPARE(match.blackboard(RobotId{1})->read(look), 0);  // ticks 0..30 began at most at 0.5 s
    match.tick();
    QCOMPARE(match.blackboard(RobotId{1})->read(look), 2);
  }

  void aPutBackMomentIsRepeated() {
    auto match = make(builtIn("one-robot"));
    for (int i = 0; i < 300; ++i) match.tick();
    const auto saved = match.simulation().state();
    for (int i = 0; i < 100; ++i) match.tick();
    QVERIFY(match.simulation().restore(saved));
    match.tick();
    QCOMPARE(match.simulation().state().tick, std::uint64_t{301});
    for (int i = 0; i < 100; ++i) match.tick();
    QVERIFY(match.simulation().state().tick == 401);
  }

  void stopConditions() {
    Scenario scenario = builtIn("empty");
    scenario.stop.duration = 1.0;
    auto timed = make(scenario);
    for (int i = 0; i < 59; ++i) timed.tick();
    QVERIFY(!timed.finished());
    timed.tick();
    QCOMPARE(timed.finishedBy(), std::string_view("duration"));

    scenario.stop = {{}, true, false};
    scenario.ball = {4.3, 0};
    scenario.ballVelocity = {3, 0};
    auto scored = make(scenario);
    for (int i = 0; i < 120 && !scored.finished(); ++i) scored.tick();
    QCOMPARE(scored.finishedBy(), std::string_view("goal"));

    scenario.stop = {{}, false, true};
    scenario.ball = {0, 2.8};
    scenario.ballVelocity = {0, 3};
    auto out = make(scenario);
    for (int i = 0; i < 120 && !out.finished(); ++i) out.tick();
    QCOMPARE(out.finishedBy(), std::string_view("ball_out"));
  }

  void robotsComeAndGo() {
    auto match = make(builtIn("match-3v3"));
    for (int i = 0; i < 60; ++i) match.tick();
    QVERIFY(match.robots().remove(RobotId{2}));
    QVERIFY(!match.blackboard(RobotId{2}));
    QCOMPARE(match.robots().remove(RobotId{2}).error().code, ErrorCode::NotFound);

    ScenarioRobot robot;
    robot.identity = {RobotId{2}, TeamColor::Red, 1, true};
    const auto before = match.simulation().state();
    QCOMPARE(match.robots().add(robot).error().code, ErrorCode::Conflict);  // R1 is there
    QVERIFY(match.simulation().state() == before);
    robot.identity.number = 9;
    robot.behaviour = "nobody";
    QVERIFY(!match.robots().add(robot));
    QVERIFY(match.simulation().state() == before);
    robot.behaviour = "naive";
    QVERIFY(match.robots().add(robot));
    // The referee's "play" of time 0 holds for it, too.
    QCOMPARE(match.blackboard(RobotId{2})->read(match.variables().comReferee), 2);
    match.tick();
  }

  void behaviourCanBeChanged() {
    auto match = make(builtIn("one-robot"));
    QVERIFY(match.robots().setBehaviour(RobotId{1}, std::string(noBehaviour)));
    for (int i = 0; i < 60; ++i) match.tick();
    QCOMPARE(match.blackboard(RobotId{1})->read(match.variables().decisionActionA), 0);
    QCOMPARE(match.robots().setBehaviour(RobotId{1}, "naiv").error().message,
             std::string("there is no behaviour \"naiv\"; did you mean \"naive\"?"));
    QVERIFY(match.robots().setBehaviour(RobotId{1}, "naive"));
    for (int i = 0; i < 60; ++i) match.tick();
    QVERIFY(match.blackboard(RobotId{1})->read(match.variables().decisionActionA) != 0);
  }

  void sharedSegmentsAreMadeAndRemoved() {
    const MatchOptions options = shared(Cognition::None);
    const int key = blackboardKey(RobotId{1}, *options.keyBase);
    {
      auto match = make(builtIn("one-robot"), options);
      QVERIFY(SystemVSegments::info(key));
      QCOMPARE(match.blackboard(RobotId{1})->read(match.variables().decisionSearchOn), 1);
      const auto second = SimulatedMatch::create(builtIn("one-robot"), options);
      QVERIFY(!second);  // two simulators would fight over the words
      QVERIFY(SystemVSegments::info(key));
      auto moved = std::move(match);
      moved.tick();
    }
    QVERIFY(!SystemVSegments::info(key));
  }

  void aSegmentThatWasThereKeepsItsValuesAndStays() {
    const MatchOptions options = shared(Cognition::None);
    const int key = blackboardKey(RobotId{1}, *options.keyBase);
    QVERIFY(SystemVSegments::create(key));
    {
      auto board = SystemVSegments::open(key, AttachMode::AttachOnly).value();
      board.write(IntVar{400}, 77);
    }
    {
      auto match = make(builtIn("one-robot"), options);
      match.tick();
      QCOMPARE(match.blackboard(RobotId{1})->read(IntVar{400}), 77);
    }
    QVERIFY(SystemVSegments::info(key));
    QVERIFY(SystemVSegments::remove(key));
  }

  void aProgramThatCannotBeStartedLeavesNothingBehind() {
    const MatchOptions options = shared(Cognition::Separate);
    const auto match = SimulatedMatch::create(builtIn("one-robot"), options);
    QVERIFY(!match);
    QVERIFY2(match.error().text().find("false-pitchboard") != std::string::npos,
             match.error().text().c_str());
    QVERIFY(!SystemVSegments::info(blackboardKey(RobotId{1}, *options.keyBase)));
  }

  void aGameComesBackFromItsText_data() { ruleSets(); }
  void aGameComesBackFromItsText() {
    QFETCH(QString, rules);
    SimulatedMatch match = make(shortMatch(rules));
    std::mt19937 random(7);
    std::set<PlayState> states;
    int seen = 0;
    for (int i = 0; i < 60 * 900 && !match.finished(); ++i) {
      match.tick();
      if (random() % 80 != 0) continue;
      ++seen;
      const Game& game = *match.simulation().state().game;
      states.insert(game.state);
      const auto text = scenarioToJson(match.toScenario());
      const auto read = scenarioFromJson(text, "moment");
      QVERIFY2(read, read ? "" : read.error().text().c_str());
      auto again = sim::Simulation::create(read->settings).value();
      QVERIFY(again.placeBall(read->ball, read->ballVelocity));
      for (const ScenarioRobot& robot : read->robots) {
        QVERIFY(again.addRobot(robot.identity, robot.pose, robot.model));
      }
      QVERIFY(again.setReferee(read->settings.referee));
      const auto begun = again.startGame(*read->game);
      QVERIFY2(begun, begun ? "" : begun.error().text().c_str());
      const Game& back = *again.state().game;
      // What a referee remembers of each robot is not kept.
      const sim::RefereeMemory& memory = match.simulation().state().refereeMemory;
      sim::RefereeMemory kept = again.state().refereeMemory;
      kept.watches = memory.watches;
      QVERIFY2(kept == memory, text.c_str());
      QVERIFY2(back.teams == game.teams, text.c_str());
      QVERIFY2(back.restart == game.restart, text.c_str());
      QVERIFY2(back == game, text.c_str());
    }
    QVERIFY(seen > 100);
    QCOMPARE(states.size(), std::size_t{5});
  }

  void aSavedMomentGoesOnWhereItWas_data() { ruleSets(); }
  void aSavedMomentGoesOnWhereItWas() {
    QFETCH(QString, rules);
    Scenario scenario = shortMatch(rules);
    scenario.settings.referee->halfTime = 600;
    SimulatedMatch match = make(scenario);
    std::set<PlayState> states;
    bool inSetPlay = false;
    for (int i = 0; i < 60 * 900 && (states.size() < 4 || !inSetPlay); ++i) {
      match.tick();
      if (match.simulation().state().tick % 30 != 0)
        continue;  // robots have just received a packet
      const Game& before = *match.simulation().state().game;
      const bool setPlay = before.restart.isAnnounced();
      if (!(setPlay && !inSetPlay) && states.contains(before.state)) continue;
      states.insert(before.state);
      inSetPlay = inSetPlay || setPlay;
      const PlayState state = before.state;
      const int clock = before.clock, countdown = before.countdown.ticks;
      const auto saved = scenarioFromJson(scenarioToJson(match.toScenario()), "moment");
      QVERIFY2(saved, saved ? "" : saved.error().text().c_str());
      SimulatedMatch goesOn = make(*saved);
      const Game& now = *goesOn.simulation().state().game;
      QCOMPARE(now.state, state);
      QCOMPARE(now.clock, clock);
      QCOMPARE(now.countdown.ticks, countdown);
      QVERIFY(now.restart == before.restart);
      QCOMPARE(goesOn.simulation().state().score, match.simulation().state().score);
      for (std::size_t robot = 0; robot < saved->robots.size(); ++robot) {
        const RobotId id = saved->robots[robot].identity.id;
        const auto word = match.variables().comReferee;
        QCOMPARE(goesOn.blackboard(id)->read(word), match.blackboard(id)->read(word));
      }
      for (int tick = 0; tick < 60; ++tick) goesOn.tick();
      QVERIFY(goesOn.simulation().state().game->clock <= clock);
    }
    QVERIFY(inSetPlay || rules == "humanoid-2014");  // which has none
    QVERIFY(states.size() >= 4);
  }

  void robotsOfASavedMomentKnowWhereTheyAre() {
    SimulatedMatch match = make(builtIn("match-3v3"));
    for (int i = 0; i < 60 * 30; ++i) match.tick();
    const Scenario moment = match.toScenario();
    QVERIFY(moment.robots[0].belief);
    SimulatedMatch goesOn = make(scenarioFromJson(scenarioToJson(moment), "moment").value());
    const auto at = [&](const SimulatedMatch& of) {
      const Blackboard& board = *of.blackboard(RobotId{1});
      return std::pair(board.read(of.variables().localizationX),
                       board.read(of.variables().localizationY));
    };
    QCOMPARE(at(goesOn), at(match));
    const float sure = match.blackboard(RobotId{1})->read(match.variables().localizationBelief);
    for (int i = 0; i < 30; ++i) goesOn.tick();
    const float then = goesOn.blackboard(RobotId{1})->read(goesOn.variables().localizationBelief);
    // A robot that has to localize itself begins with an error of metres.
    QVERIFY2(then < 3 * sure + 30, qPrintable(QString("%1 cm, then %2").arg(sure).arg(then)));
  }

  void aMomentIsAScenario() {
    Scenario scenario = builtIn("match-3v3");
    scenario.writes.push_back(writeAt(3, 1, "COM_REFEREE", 1));
    scenario.writes.push_back(writeAt(20, 0, "COM_REFEREE", 12));
    auto match = make(scenario);
    for (int i = 0; i < 600; ++i) match.tick();
    const Scenario moment = match.toScenario();
    QCOMPARE(moment.title, std::string("Match 3 against 3, at 10.0 s"));
    QCOMPARE(moment.writes.size(), std::size_t{3});
    QCOMPARE(moment.writes[1], writeAt(0, 1, "COM_REFEREE", 1));
    QCOMPARE(moment.writes[2].time, 10.0);
    const auto snapshot = match.simulation().snapshot();
    QCOMPARE(moment.robots[3].pose, snapshot.robots[3].pose);
    const auto again = scenarioFromJson(scenarioToJson(moment), "moment");
    QVERIFY2(again, again ? "" : again.error().text().c_str());
    QCOMPARE(again->robots.size(), moment.robots.size());
  }
};

QTEST_GUILESS_MAIN(TestSimulatedMatch)
#include "tst_simulated_match.moc"
