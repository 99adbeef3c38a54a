// SPDX-License-Identifier: GPL-3.0-or-later
// What recorded GameController packets of several versions mean in COM_REFEREE.
#include <robotlink/cognition/referee_word.h>

#include <QtTest>

#include "../support/recorded_packets.h"

namespace tst_referee_word {

using namespace pitchboard;

namespace {

telemetry::RefereeState recorded(const char* name) {
  const auto packet = telemetry::decodeReferee(recordedPacket(name));
  return std::get<telemetry::RefereeState>(packet.value());
}

}  // namespace

class TestRefereeWord : public QObject {
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
        // Who has not got the kick-off stands until the ball is free.
        const bool waits = word == link::refereePlay && state.secondaryTime.value_or(0) > 0 &&
                           state.kickOffTeam && state.kickOffTeam != team.number;
        if (waits) {
          const auto stands = link::refereeWord(state, team.number, static_cast<int>(i) + 1);
          QCOMPARE(stands.value_or(-1), link::refereeSet);
          continue;
        }
        const auto said = link::refereeWord(state, team.number, static_cast<int>(i) + 1);
        QCOMPARE(said.value_or(-1), word);
      }
    }
    // A shirt that has no slot is not penalised.
    QCOMPARE(link::refereeWord(state, state.teams[0].number, 99).value_or(-1), word);
  }

  void aPenalisedRobotStands() {
    const auto state = recorded("v11hl592_PENALISED");
    int penalised = 0;
    for (const telemetry::RefereeTeam& team : state.teams) {
      for (std::size_t i = 0; i < team.players().size(); ++i) {
        const auto said = link::refereeWord(state, team.number, static_cast<int>(i) + 1);
        if (team.players()[i].penalty != 0) {
          QCOMPARE(said.value_or(-1), link::refereeStop);
          ++penalised;
        }
      }
    }
    QVERIFY(penalised > 0);
  }

  void anotherTeamsMatchSaysNothing() {
    QVERIFY(!link::refereeWord(recorded("v11hl592_PLAYING"), 97, 1));
  }

  void trueDataIsNotForRobots() {
    auto state = recorded("v11hl592_PLAYING");
    state.magic[2] = 'T';
    QVERIFY(!link::refereeWord(state, state.teams[0].number, 1));
  }
};

PITCHBOARD_TEST(TestRefereeWord)

}  // namespace tst_referee_word

#include "tst_referee_word.moc"
