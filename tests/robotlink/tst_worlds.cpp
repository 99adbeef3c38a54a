// SPDX-License-Identifier: GPL-3.0-or-later
// What makes many worlds fast, without a clock: worlds that the caller steers are no matches and do
// the same, and threads share the work when it pays.

#include <QtTest>
#include <bit>
#include <vector>

#include <robotlink/capi/worlds.h>

#include "match_worlds.h"
#include "steered_worlds.h"
#include "step_team.h"

namespace tst_worlds {

using namespace pitchboard;
using namespace pitchboard::link;
using Seconds = StepTeam::Seconds;

class TestWorlds : public QObject {
  Q_OBJECT

 private slots:
  void steeredWorldsDoWhatMatchesDo_data() {
    QTest::addColumn<QString>("scenario");
    QTest::addColumn<QString>("noise");
    for (const char* scenario : {"one-robot", "match-3v3", "published-match-3v3"}) {
      for (const char* noise : {"none", "paper", "realistic"}) {
        QTest::addRow("%s, %s", scenario, noise) << scenario << noise;
      }
    }
  }
  void steeredWorldsDoWhatMatchesDo() {
    QFETCH(QString, scenario);
    QFETCH(QString, noise);
    const Scenario played = steered(scenario.toStdString(), noise.toStdString());
    constexpr std::size_t count = 3;
    MatchWorlds matches(played, {});
    for (std::size_t i = 0; i < count; ++i) {
      QVERIFY(matches.add(played.settings.seed + i).has_value());
    }
    auto steeredWorlds = SteeredWorlds::create(played, {}, count, 1);
    QVERIFY(steeredWorlds.has_value() && *steeredWorlds);
    StepTeam team;
    constexpr int actions[] = {1, 2, 8, 4, 3, 17, 6, 1, 5};
    for (int turn = 0; turn < 100; ++turn) {
      for (WorldGroup* group :
           {static_cast<WorldGroup*>(&matches), static_cast<WorldGroup*>(steeredWorlds->get())}) {
        int row = turn / 10;
        for (Blackboard& board : group->boards()) {
          const RobotVariables v;
          board.write(group->placed(v.decisionActionA), actions[row++ % 9]);
          board.write(group->placed(v.decisionActionVision), turn / 30 % 3);
          board.write(group->placed(v.decisionLocalization), turn / 20 % 2);
          if (turn == 50) board.write(group->placed(v.imuReset), 1);
        }
        group->step(team, 1 + turn % 7);
      }
      for (std::size_t i = 0; i < count; ++i) {
        QCOMPARE(seen(**steeredWorlds, i), seen(matches, i));
        QCOMPARE((*steeredWorlds)->finishedBy(i), matches.finishedBy(i));
      }
      QCOMPARE(percepts(**steeredWorlds, count * played.robots.size()),
               percepts(matches, count * played.robots.size()));
    }
  }

  void whoRemembersIsAMatch() {
    const auto isSteered = [](const Scenario& scenario) {
      return SteeredWorlds::create(scenario, {}, 1, 1).value() != nullptr;
    };
    QVERIFY(!isSteered(loadScenario("one-robot").value()));
    Scenario played = steered("one-robot", "none");
    QVERIFY(isSteered(played));
    played.writes.push_back({RobotId{1}, "VISION_LOST", 1.0, 1.0});
    QVERIFY(!isSteered(played));
  }

  /// A robot that gets a behaviour, loses it and gets it again plays as it would in a match.
  void behavioursMayChangeWhileItIsPlayed() {
    const Scenario played = steered("match-3v3", "paper");
    WorldsOptions options;
    options.count = 2;
    auto worlds = Worlds::create(played, options).value();
    MatchWorlds matches(played, {});
    for (std::uint64_t i = 0; i < 2; ++i) {
      QVERIFY(matches.add(played.settings.seed + i).has_value());
    }
    StepTeam team;
    for (const char* behaviour : {"none", "striker", "none", "keeper"}) {
      QVERIFY(worlds.setBehaviour(RobotId{2}, behaviour).has_value());
      QVERIFY(matches.setBehaviour(RobotId{2}, behaviour).has_value());
      QVERIFY(worlds.step(200).has_value());
      matches.step(team, 200);
      std::vector<std::uint64_t> hashes(2);
      QVERIFY(worlds.readHashes(hashes).has_value());
      for (std::size_t i = 0; i < 2; ++i) QCOMPARE(hashes[i], seen(matches, i).first);
    }
  }

  /// What was saved while a robot had a behaviour goes on with it.
  void aSnapshotBringsItsBehaviours() {
    Scenario played = loadScenario("one-robot").value();
    auto worlds = Worlds::create(played, {}).value();
    QVERIFY(worlds.step(100).has_value());
    const WorldSnapshot saved = worlds.snapshot(0).value();
    std::array<std::vector<std::uint64_t>, 2> hashes;
    for (auto& hash : hashes) {
      QVERIFY(worlds.restore(0, saved).has_value());
      QVERIFY(worlds.step(300).has_value());
      hash.resize(1);
      QVERIFY(worlds.readHashes(hash).has_value());
      QVERIFY(worlds.setBehaviour(RobotId{1}, "none").has_value());
    }
    QCOMPARE(hashes[1], hashes[0]);
  }

  void littleWorkIsNotShared() {
    constexpr Seconds tick(1e-6);
    QVERIFY(!StepTeam::isWorthSharing(16, 1, tick));
    QVERIFY(!StepTeam::isWorthSharing(64, 1, tick));
    QVERIFY(StepTeam::isWorthSharing(1024, 1, tick));
    // Few worlds with much to do each, and worlds of which nothing is known yet.
    QVERIFY(StepTeam::isWorthSharing(2, 1000, tick));
    QVERIFY(StepTeam::isWorthSharing(2, 1, Seconds(1e-3)));
    QVERIFY(StepTeam::isWorthSharing(16, 1, Seconds{}));
    QVERIFY(!StepTeam::isWorthSharing(1, 1000, Seconds(1.0)));
  }

  void everyPieceIsDoneOnce() {
    StepTeam team;
    QVERIFY(team.start(3).has_value());
    for (const std::size_t pieces : {0U, 1U, 7U, 64U, 1000U, 3U}) {
      std::vector<std::atomic<int>> done(pieces);
      team.run(pieces, 1, [&](std::size_t worker, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && worker < team.workers(); ++i) ++done[i];
      });
      for (const auto& one : done) QCOMPARE(one.load(), 1);
    }
  }

 private:
  /// A scenario whose robots the caller steers.
  static Scenario steered(const std::string& name, const std::string& noise) {
    Scenario played = changed(loadScenario(name).value(), {{}, noise, {}, 0.0}).value();
    for (ScenarioRobot& robot : played.robots) robot.behaviour = noBehaviour;
    return played;
  }
  /// The hash and the blackboards of a world.
  static std::pair<std::uint64_t, std::vector<std::uint32_t>> seen(WorldGroup& worlds,
                                                                   std::size_t world) {
    const WorldSnapshot saved = worlds.snapshot(world);
    std::vector<std::uint32_t> words;
    for (const MomentRobot& robot : saved.moment.robots) {
      for (const BoardWord& word : robot.words) words.push_back(word.bits);
    }
    return {sim::stateHash(saved.moment.state), words};
  }
  static std::vector<std::uint64_t> percepts(const WorldGroup& worlds, std::size_t rows) {
    std::vector<double> values(rows * columnsOf(WorldArray::Percepts).size());
    worlds.readPercepts(values);
    std::vector<std::uint64_t> bits;
    for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
    return bits;
  }
};

PITCHBOARD_TEST(TestWorlds)

}  // namespace tst_worlds

#include "tst_worlds.moc"
