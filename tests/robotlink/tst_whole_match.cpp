// SPDX-License-Identifier: GPL-3.0-or-later
// The default scenario from kick-off to the final whistle, with short halves, by each rule set.
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/referee_rule_sets.h>

#include <QFile>
#include <QTemporaryDir>
#include <QtTest>
#include <map>
#include <optional>

#include <telemetry/referee/gamecontroller.h>

#include "../support/segment_keys.h"
#include "../support/test_socket.h"

#include "match_watch.h"

namespace tst_whole_match {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Scenario shortMatch(const char* rules) {
  Scenario scenario = loadScenario("match").value();
  scenario.settings.referee = refereeRuleSet(rules).value();
  scenario.settings.referee->halfTime = 60;
  scenario.settings.referee->breakTime = 10;
  return scenario;
}

SimulatedMatch make(const Scenario& scenario) {
  MatchOptions options;
  options.process.particles = 200;
  return SimulatedMatch::create(scenario, options).value();
}

double forward(const Game& game, const sim::RobotSnapshot& robot) {
  const bool right = game.attacksRight(static_cast<std::size_t>(game.teamOf(robot.identity.team)));
  return (right ? 1.0 : -1.0) * robot.pose.position.x;
}

}  // namespace

class TestWholeMatch : public QObject {
  Q_OBJECT
 private slots:
  void kickOffToFinalWhistle_data() {
    QTest::addColumn<QString>("rules");
    for (const char* rules : {"humanoid-2014", "humanoid-2021", "humanoid-soccer-2026"}) {
      QTest::newRow(rules) << QString(rules);
    }
  }
  void kickOffToFinalWhistle() {
    QFETCH(QString, rules);
    auto match = make(shortMatch(qPrintable(rules)));
    MatchWatch watch;
    sim::Snapshot now;
    while (match.finishedBy() != "full_time" && match.simulation().state().tick < 900 * 60) {
      match.tick();
      const sim::WorldState& world = match.simulation().state();
      watch.ticked(world, match.simulation().events());
      if (world.tick % 6 != 0) continue;
      match.simulation().snapshot(now);
      watch.sample(world, now);
    }
    const sim::WorldState& world = match.simulation().state();
    QVERIFY(world.game->over);
    QCOMPARE(match.finishedBy(), std::string_view("full_time"));
    QCOMPARE(watch.illegalTransitions(), 0);
    QVERIFY(watch.maxStuck() <= 60.0);
    QVERIFY(world.tick > 200 * 60);
    QVERIFY(world.game->swapped);  // the second half
  }

  // Ours are told again where they attack; a team's own programs go on as on a real field.
  void halfTimeKeepsTeamPrograms() {
    const QTemporaryDir folder;
    QFile file(folder.filePath("team.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "name": "team", "processes": [
      {"name": "localization", "reference": "localization"},
      {"name": "decision", "command": ["/bin/sleep", "600"]}]})");
    file.close();
    Scenario scenario = shortMatch("humanoid-2021");
    scenario.settings.referee->halfTime = 5;
    scenario.settings.referee->breakTime = 1;
    scenario.settings.referee->beforeMatch = 1;
    scenario.robots[0].runtime.profile = file.fileName().toStdString();
    MatchOptions options;
    options.keyBase = testKeyBase();
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    auto match = SimulatedMatch::create(scenario, options).value();
    const auto& processes = match.robots().all()[0]->processes;
    QCOMPARE(processes.size(), std::size_t{2});
    const CognitiveProcess* const ours = processes[0]->inside.get();
    const int id = processes[1]->id;
    const pid_t pid = match.robots().processes().status(id)->pid;
    QVERIFY(pid != 0);
    while (!match.simulation().state().game->swapped && !match.finished()) match.tick();
    match.tick();
    QVERIFY(match.simulation().state().game->swapped);
    QCOMPARE(processes.size(), std::size_t{2});
    QVERIFY(processes[0]->inside.get() != ours);
    QCOMPARE(processes[1]->id, id);
    QCOMPARE(match.robots().processes().status(id)->pid, pid);
    QCOMPARE(match.robots().processes().status(id)->restarts, 0);
  }

  void everyRobotIsInItsPlaceAtKickOff() {
    auto match = make(shortMatch("humanoid-2021"));
    sim::Snapshot now;
    int touched = 0;
    std::vector<Point> inSet;
    double moved = 0.0;
    while (match.simulation().state().game->state != PlayState::Playing) {
      match.tick();
      match.simulation().snapshot(now);
      const PlayState state = match.simulation().state().game->state;
      for (std::size_t i = 0; i < now.robots.size(); ++i) {
        for (std::size_t j = 0; j < i && state == PlayState::Ready; ++j) {
          const double d =
              std::hypot(now.robots[i].pose.position.x - now.robots[j].pose.position.x,
                         now.robots[i].pose.position.y - now.robots[j].pose.position.y);
          if (d < 2 * match.simulation().state().settings.field.robotRadius + 0.001) ++touched;
        }
        if (state != PlayState::Set || match.simulation().state().game->stateTicks < 90) {
          continue;
        }
        // The word is half a second old at most, and the gait needs a moment to stop.
        if (inSet.size() <= i) inSet.push_back(now.robots[i].pose.position);
        moved = std::max(moved, std::hypot(now.robots[i].pose.position.x - inSet[i].x,
                                           now.robots[i].pose.position.y - inSet[i].y));
      }
    }
    QCOMPARE(touched, 0);
    QVERIFY2(moved < 0.02, qPrintable(QString::number(moved)));
    const Game& game = *match.simulation().state().game;
    for (const sim::RobotSnapshot& robot : now.robots) {
      QVERIFY2(forward(game, robot) < 0.0, robot.identity.name().c_str());
      const Point& p = robot.pose.position;
      QVERIFY(std::hypot(p.x, p.y) >
              match.simulation().state().settings.field.centreCircleDiameter / 2);
      QVERIFY(std::abs(p.x) < 4.5 && std::abs(p.y) < 3.0);
    }
  }

  void robotsReceiveTheRefereeAtItsRate() {
    auto match = make(shortMatch("humanoid-2021"));
    const auto word = [&](int robot) {
      return match.blackboard(RobotId{robot})->read(match.variables().comReferee);
    };
    QCOMPARE(word(1), refereeStop);
    const auto wait = [&](PlayState state) {
      while (match.simulation().state().game->state != state) match.tick();
      const std::uint64_t then = match.simulation().state().tick;
      while (match.simulation().state().tick < then + 31) match.tick();
    };
    wait(PlayState::Ready);
    QCOMPARE(word(1), refereeReady);
    wait(PlayState::Set);
    QCOMPARE(word(1), refereeSet);
    wait(PlayState::Playing);
    QCOMPARE(word(1), refereePlay);
    QCOMPARE(word(5), refereeSet);  // blue has the kick-off
    QVERIFY(match.simulation().call(
        {.kind = sim::CallKind::Penalise, .robot = RobotId{1}, .penalty = PenaltyKind::Manual}));
    for (int i = 0; i < 31; ++i) match.tick();
    QCOMPARE(word(1), refereeStop);
  }

  // The one who had the kick-off does not take the other's throw-in.
  void aSetPlayIsItsTakersUntilTheBallIsFree() {
    Scenario scenario = shortMatch("humanoid-2021");
    scenario.settings.referee->readyTime = 1;
    scenario.settings.referee->placingTime = 1;
    scenario.settings.referee->prepareTime = 2;
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = std::string(noBehaviour);
    auto match = make(scenario);
    const Game& game = *match.simulation().state().game;
    while (game.state != PlayState::Playing) match.tick();
    for (int i = 0; i < 60 * 11; ++i) match.tick();
    QCOMPARE(game.kickOff, 0);
    QVERIFY(match.simulation().call({.kind = sim::CallKind::SetPlay,
                                     .team = 1,
                                     .setPlay = SetPlay::ThrowIn,
                                     .place = Point{0.0, 3.0}}));
    const auto word = [&](int robot) {
      return match.blackboard(RobotId{robot})->read(match.variables().comReferee);
    };
    int executed = 0;
    for (int i = 0; i < 60 * 12; ++i) {
      match.tick();
      if (i < 31 || match.simulation().state().tick % 30 != 0) continue;  // as robots hear it
      const bool taken = !game.restart.isAnnounced();
      if (taken && game.countdown.ticks > 0) ++executed;
      if (game.countdown.ticks > 0 || !taken) {
        QVERIFY(word(1) != refereePlay);
        if (taken) QCOMPARE(word(5), refereePlay);
      }
    }
    QVERIFY(executed > 10);
  }

  void itsPacketsArriveOnTheMatchsPort() {
    constexpr std::uint32_t loopbackBroadcast = 0x7fffffff;  // 127.255.255.255
    const TestSocket socket(loopbackBroadcast);
    QVERIFY(socket.good());
    MatchOptions options;
    options.process.particles = 200;
    options.process.refereePort = socket.port();
    options.sendReferee = true;
    auto match = SimulatedMatch::create(shortMatch("humanoid-2014"), options).value();
    for (int i = 0; i < 60 * 12; ++i) match.tick();
    std::map<int, int> versions;
    std::optional<telemetry::RefereeState> last;
    for (std::string text = socket.take(); !text.empty(); text = socket.take()) {
      const auto packet = telemetry::decodeReferee(text);
      QVERIFY(packet);
      const auto& state = std::get<telemetry::RefereeState>(*packet);
      ++versions[state.version];
      if (state.version == 9) last = state;
    }
    // Twice a second, each with the one of version 7 behind it.
    QVERIFY(versions[9] >= 24 && versions[9] <= 26);
    QCOMPARE(versions[7], versions[9]);
    QCOMPARE(last->state, 1);
    QCOMPARE(*last->secondaryTime, 28);
    QCOMPARE(last->teams[0].players()[4].penalty, 14);  // nobody wears this shirt
  }

  void anOutsideGameControllerIsObeyed() {
    const TestSocket place;  // a free port; given back before the match listens
    int port = 0;
    {
      const TestSocket probe;
      port = probe.port();
    }
    MatchOptions options;
    options.process.particles = 200;
    options.obeyReferee = port;
    auto match = SimulatedMatch::create(shortMatch("humanoid-2021"), options).value();
    const auto send = [&](const char* name) {
      QFile file(QString(PITCHBOARD_TEST_DATA) + "/gamecontroller/" + name + ".bin");
      QVERIFY(file.open(QIODevice::ReadOnly));
      QVERIFY(place.send(static_cast<std::uint16_t>(port), file.readAll().toStdString()));
    };
    const auto state = [&] {
      match.tick();
      return static_cast<int>(match.simulation().state().game->state);
    };
    for (int i = 0; i < 60 * 20; ++i) match.tick();
    QCOMPARE(state(), 0);  // nobody has said a word
    send("v12hl640_2017.3_PLAYING");
    QTRY_COMPARE(state(), 3);
    QCOMPARE(match.blackboard(RobotId{1})->read(match.variables().comReferee) != refereeStop, true);
    send("v12hl640_2017.3_SECOND_HALF_PLAYING");
    QTRY_COMPARE((state(), match.simulation().state().game->half), 2);
  }

  void aMatchToObeyNeedsRules() {
    MatchOptions options;
    options.obeyReferee = 3838;
    const auto refused = SimulatedMatch::create(loadScenario("match-3v3").value(), options);
    QVERIFY(!refused);
    QVERIFY(refused.error().text().find("has no referee") != std::string::npos);
  }

  void itRepeatsToTheBit() {
    const auto hashOf = [] {
      auto match = make(shortMatch("humanoid-soccer-2026"));
      for (int i = 0; i < 60 * 120; ++i) match.tick();
      return match.simulation().hash();
    };
    QCOMPARE(hashOf(), hashOf());
  }
};

PITCHBOARD_TEST(TestWholeMatch)

}  // namespace tst_whole_match

#include "tst_whole_match.moc"
