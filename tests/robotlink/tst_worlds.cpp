// SPDX-License-Identifier: GPL-3.0-or-later
// What makes many worlds fast, without a clock: how much memory a world asks for ahead of its turn,
// and when its threads share the work.

#include <QtTest>
#include <memory>
#include <vector>

#include "step_team.h"
#include "world.h"

namespace tst_worlds {

using namespace pitchboard;
using namespace pitchboard::link;
using Seconds = StepTeam::Seconds;

class TestWorlds : public QObject {
  Q_OBJECT

 private slots:
  /// The parts of a world are objects of their own, anywhere in memory: one on the stack, one
  /// beside others, one made after much else.
  void aWorldAsksForItsOwnMemoryOnly() {
    const Scenario scenario = loadScenario("one-robot").value();
    constexpr std::size_t most = 200;  // cache lines
    World first = World::create(scenario, {}, 1).value();
    const std::size_t lines = first.fetchSelf();
    QVERIFY2(lines > 10 && lines < most, std::to_string(lines).c_str());
    std::vector<World> worlds;
    std::vector<std::unique_ptr<std::vector<char>>> between;
    for (int i = 0; i < 20; ++i) {
      between.push_back(std::make_unique<std::vector<char>>(1 << 20));
      worlds.push_back(World::create(scenario, {}, 1).value());
    }
    for (const World& world : worlds) {
      const std::size_t asked = world.fetchSelf();
      QVERIFY2(asked < most, std::to_string(asked).c_str());
    }
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
      team.run(pieces, 1, [&](std::size_t i, std::size_t end) {
        if (end <= pieces) ++done[i];
      });
      for (const auto& one : done) QCOMPARE(one.load(), 1);
    }
  }
};

PITCHBOARD_TEST(TestWorlds)

}  // namespace tst_worlds

#include "tst_worlds.moc"
