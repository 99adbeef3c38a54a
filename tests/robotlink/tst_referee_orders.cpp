// SPDX-License-Identifier: GPL-3.0-or-later
// What recorded GameController packets of several versions mean in COM_REFEREE.
#include <robotlink/cognition/referee_orders.h>

#include <QtTest>

#include <telemetry/referee/gamecontroller.h>

#include "../support/recorded_packets.h"

namespace tst_referee_orders {

using namespace pitchboard;

namespace {

telemetry::RefereeState recorded(const char* name) {
  const auto packet = telemetry::decodeReferee(recordedPacket(name));
  return std::get<telemetry::RefereeState>(packet.value());
}

/// Of a robot that has just been started.
std::optional<int> wordOf(const telemetry::RefereeState& state, int team, int player) {
  return link::RefereeOrders().take(telemetry::gameOf(state), team, player);
}

/// A packet of the Humanoid League, 688 bytes, of teams 1 and 2.
telemetry::RefereeState humanoid(int state, int kickOff, int secondary, int time,
                                 std::array<int, 4> info = {}) {
  telemetry::RefereeState out = recorded("v12hl688_READY");
  out.teams[0].number = 1;
  out.teams[1].number = 2;
  out.state = state;
  out.kickOffTeam = kickOff;
  out.secState = secondary;
  out.secStateInfo = info;
  out.secondaryTime = time;
  for (telemetry::RefereeTeam& team : out.teams) team.allSlots[0].penalty = 0;
  return out;
}

}  // namespace

class TestRefereeOrders : public QObject {
  Q_OBJECT
 private slots:
  void recordedPackets_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("word");
    QTest::newRow("HL 2017 initial") << "v11hl592_INITIAL" << 1;
    QTest::newRow("HL 2017 playing") << "v11hl592_PLAYING" << 2;
    QTest::newRow("HL 2017 finished") << "v11hl592_FINISHED" << 1;
    QTest::newRow("HL 2017 timeout") << "v11hl592_TIMEOUT" << 1;
    QTest::newRow("HL 2018 timeout") << "v12hl640_2017.3_TIMEOUT" << 1;
    QTest::newRow("HL 2018 second half") << "v12hl640_2017.3_SECOND_HALF_PLAYING" << 2;
    QTest::newRow("SPL 2018 ready") << "v11spl58_READY" << 11;
    QTest::newRow("SPL 2018 set") << "v11spl58_SET" << 12;
    QTest::newRow("SPL 2017 ready") << "v10spl588_READY" << 11;
  }
  void recordedPackets() {
    QFETCH(QString, file);
    QFETCH(int, word);
    const auto state = recorded(qPrintable(file));
    for (const telemetry::RefereeTeam& team : state.teams) {
      for (std::size_t i = 0; i < team.players().size(); ++i) {
        if (team.players()[i].penalty != 0) continue;
        // The team without the kick-off stands until the ball is free.
        const bool waits = word == link::refereePlay && state.secondaryTime.value_or(0) > 0 &&
                           state.kickOffTeam && state.kickOffTeam != team.number;
        if (waits) {
          const auto stands = wordOf(state, team.number, static_cast<int>(i) + 1);
          QCOMPARE(stands.value_or(-1), link::refereeSet);
          continue;
        }
        const auto reported = wordOf(state, team.number, static_cast<int>(i) + 1);
        QCOMPARE(reported.value_or(-1), word);
      }
    }
    // A shirt that has no slot is not penalised.
    QCOMPARE(wordOf(state, state.teams[0].number, 99).value_or(-1), word);
  }

  void aPenalisedRobotStands() {
    const auto state = recorded("v11hl592_PENALISED");
    int penalised = 0;
    for (const telemetry::RefereeTeam& team : state.teams) {
      for (std::size_t i = 0; i < team.players().size(); ++i) {
        const auto reported = wordOf(state, team.number, static_cast<int>(i) + 1);
        if (team.players()[i].penalty != 0) {
          QCOMPARE(reported.value_or(-1), link::refereeStop);
          ++penalised;
        }
      }
    }
    QVERIFY(penalised > 0);
  }

  void aMatchOfOtherTeamsGivesNoOrder() { QVERIFY(!wordOf(recorded("v11hl592_PLAYING"), 97, 1)); }

  // Team 1 has had the kick-off, team 2 takes a throw-in.
  void aSetPlayIsItsTakersUntilTheBallIsFree() {
    constexpr int throwIn = 9, overtime = 2;
    for (const int phase : {0, overtime}) {
      struct Step {
        telemetry::RefereeState packet;
        int takers, others;
      };
      const std::vector<Step> steps{
          {humanoid(3, 1, throwIn, 0, {2, 0}), link::refereeStop, link::refereeStop},
          {humanoid(3, 1, throwIn, 15, {2, 1}), link::refereePlay, link::refereeReady},
          {humanoid(3, 1, throwIn, 0, {2, 2}), link::refereePlay, link::refereeReady},
          {humanoid(3, 1, phase, 10), link::refereePlay, link::refereeSet},
          {humanoid(3, 1, phase, 3), link::refereePlay, link::refereeSet},
          {humanoid(3, 1, phase, 0), link::refereePlay, link::refereePlay},
          // Nothing is left of it at the next kick-off.
          {humanoid(2, 1, phase, 0), link::refereeSet, link::refereeSet},
          {humanoid(3, 1, phase, 10), link::refereeSet, link::refereePlay}};
      link::RefereeOrders takers, others;
      for (const Step& step : steps) {
        const Game game = telemetry::gameOf(step.packet);
        const auto take = takers.take(game, 2, 1), wait = others.take(game, 1, 1);
        QVERIFY(take && wait);
        QCOMPARE(*take, step.takers);
        QCOMPARE(*wait, step.others);
        const bool given = step.packet.secState == throwIn;
        QCOMPARE(game.setPlay(), given ? SetPlay::ThrowIn : SetPlay::None);
        QCOMPARE(game.setPlayTeam(), given ? game.teamNumbered(2) : Game::noTeam);
      }
    }
  }

  void theOtherSideWaitsAtAKickOff_data() {
    QTest::addColumn<int>("phase");
    QTest::addColumn<int>("word");
    QTest::newRow("normal") << 0 << link::refereeSet;
    QTest::newRow("shoot-out") << 1 << link::refereePlay;
    QTest::newRow("overtime") << 2 << link::refereeSet;
    QTest::newRow("timeout") << 3 << link::refereeStop;
  }
  void theOtherSideWaitsAtAKickOff() {
    QFETCH(int, phase);
    QFETCH(int, word);
    QCOMPARE(wordOf(humanoid(3, 1, phase, 10), 2, 1).value_or(-1), word);
    auto soccer = humanoid(3, 1, 0, 10);
    soccer.league = League::HumanoidSoccer;
    soccer.secState.reset();
    soccer.gamePhase = phase;
    soccer.setPlay = 0;
    QCOMPARE(wordOf(soccer, 2, 1).value_or(-1), word);
  }
};

PITCHBOARD_TEST(TestRefereeOrders)

}  // namespace tst_referee_orders

#include "tst_referee_orders.moc"
