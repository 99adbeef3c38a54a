// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/referee/referee_tracker.h>

#include <QtTest>
#include <map>

namespace tst_referee_tracker {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;

namespace {

const WallTime start{1'700'000'000s};
const Sender referee{{0x0a000001}, 3838};
const Sender sameHost{{0x0a000001}, 40000};
const Sender other{{0x0a000002}, 3838};

RefereeState state(int version, int number = 0, int score = 0) {
  RefereeState out;
  out.version = version;
  if (version > 7) out.packetNumber = number;
  out.teams[0].score = score;
  return out;
}

bool shows(RefereeTracker& tracker, const RefereeState& packet, const Sender& sender,
           WallTime time) {
  return tracker.accept(packet, sender, time) == RefereeTracker::Verdict::Shown;
}

}  // namespace

class TestRefereeTracker : public QObject {
  Q_OBJECT
 private slots:
  void compatibilityPacketsDoNotFlicker() {
    for (const int version : {8, 9}) {
      RefereeTracker tracker;
      for (int tick = 0; tick < 20; ++tick) {
        const WallTime now = start + tick * 500ms;
        QVERIFY(shows(tracker, state(version, tick), referee, now));
        QVERIFY(!shows(tracker, state(7), sameHost, now + 50ms));
        QCOMPARE(tracker.state()->version, version);
      }
      QCOMPARE(tracker.counts().compatibility, std::uint64_t(20));
      QCOMPARE(tracker.counts().lost, std::uint64_t(0));
      QVERIFY(!tracker.conflict(start + 10s));
    }
  }

  void theLowerVersionFirst() {
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(7), referee, start));
    QVERIFY(shows(tracker, state(9), referee, start + 50ms));
    QVERIFY(!shows(tracker, state(7), referee, start + 500ms));
  }

  void anOldControllerTakesOverWhenTheNewOneIsGone() {
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(9), referee, start));
    QVERIFY(!shows(tracker, state(7), referee, start + 2900ms));
    QVERIFY(shows(tracker, state(7), referee, start + 3000ms));
    QCOMPARE(tracker.state()->version, 7);
  }

  void aSecondControllerIsFlaggedAndWaits() {
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(12, 1, 3), referee, start));
    QVERIFY(!shows(tracker, state(12, 9, 0), other, start + 100ms));
    QVERIFY(tracker.conflict(start + 1s));
    QCOMPARE(tracker.state()->teams[0].score, 3);
    QCOMPARE(*tracker.sender(), referee);
    QVERIFY(!tracker.conflict(start + 4s));
    QVERIFY(shows(tracker, state(12, 10, 0), other, start + 4s));
  }

  void trueDataIsNotARefereeState() {
    RefereeTracker tracker;
    RefereeState secret = state(20);
    secret.magic = {'R', 'G', 'T', 'D'};
    QVERIFY(!shows(tracker, secret, referee, start));
    QVERIFY(!tracker.state());
    QVERIFY(tracker.trueGame().has_value() && !tracker.game());
  }

  void lossAndAge() {
    RefereeTracker tracker;
    QVERIFY(!tracker.age(start));
    QVERIFY(!tracker.timedOut(start));
    QVERIFY(shows(tracker, state(12, 254), referee, start));
    QVERIFY(shows(tracker, state(12, 255), referee, start + 1s));
    QVERIFY(shows(tracker, state(12, 2), referee, start + 2s));
    QCOMPARE(tracker.counts().lost, std::uint64_t(2));
    // Far off: the program was started again, no packet was lost.
    QVERIFY(shows(tracker, state(12, 200), referee, start + 3s));
    QCOMPARE(tracker.counts().lost, std::uint64_t(2));
    QCOMPARE(*tracker.age(start + 5s), Duration(2s));
    QCOMPARE(*tracker.age(start), Duration(0));
    QVERIFY(!tracker.timedOut(start + 12999ms));
    QVERIFY(tracker.timedOut(start + 13s));
  }

  // The same broadcast arrives by cable, and by Wi-Fi a quarter of a second later; while play is
  // stopped the referee sends five times a second. A goal was shown, taken back and shown again.
  void latePacketsChangeNothing() {
    RefereeTracker tracker;
    std::map<Duration, RefereeState> arrivals;
    for (int i = 0; i < 16; ++i) {
      const RefereeState packet = state(20, (250 + i) & 0xff, i < 8 ? 0 : 1);
      arrivals[i * 200ms] = packet;
      arrivals[i * 200ms + 250ms] = packet;
    }
    int shown = -1;
    for (const auto& [at, packet] : arrivals) {
      tracker.accept(packet, referee, start + at);
      const int number = (*tracker.state()->packetNumber - 250) & 0xff;
      QVERIFY2(number >= shown, qPrintable(QString::number(number)));
      QCOMPARE(tracker.state()->teams[0].score, number < 8 ? 0 : 1);
      shown = number;
    }
    QCOMPARE(shown, 15);
    QCOMPARE(tracker.counts().shown, std::uint64_t(16));
    QCOMPARE(tracker.counts().late + tracker.counts().repeated, std::uint64_t(16));
    QCOMPARE(tracker.counts().lost, std::uint64_t(0));
  }

  void aRepeatedPacketKeepsTheRefereeOnline() {
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(20, 7), referee, start));
    QVERIFY(tracker.accept(state(20, 7), referee, start + 2s) == RefereeTracker::Verdict::Repeated);
    QCOMPARE(*tracker.age(start + 2s), Duration(0));
  }

  // Versions of ours up to 0.21 repeated the number in the first packet that says "stopped".
  void otherContentWithTheSameNumberIsNew() {
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(20, 176), referee, start));
    RefereeState stopped = state(20, 176);
    stopped.stopped = 1;
    QVERIFY(shows(tracker, stopped, referee, start + 100ms));
    QCOMPARE(tracker.state()->stopped, std::optional(1));
  }

  void aRestartIsRecognized_data() {
    QTest::addColumn<quint16>("port");
    QTest::addColumn<int>("number");
    QTest::addColumn<int>("first");   // ms after the last packet before it
    QTest::addColumn<int>("period");  // ms
    QTest::addColumn<int>("shown");   // which of its packets is the first that is shown
    QTest::newRow("other source port") << quint16(40000) << 95 << 100 << 500 << 0;
    QTest::newRow("silence") << referee.port << 95 << 3000 << 500 << 0;
    QTest::newRow("a number that is far off") << referee.port << 0 << 100 << 500 << 0;
    QTest::newRow("lasting lower numbers") << referee.port << 90 << 500 << 500 << 2;
    QTest::newRow("lasting lower numbers, fast") << referee.port << 81 << 200 << 200 << 5;
  }
  void aRestartIsRecognized() {
    QFETCH(quint16, port);
    QFETCH(int, number);
    QFETCH(int, first);
    QFETCH(int, period);
    QFETCH(int, shown);
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(20, 100, 4), referee, start));
    for (int i = 0; i <= shown; ++i) {
      const WallTime now = start + std::chrono::milliseconds(first + i * period);
      QCOMPARE(shows(tracker, state(20, number + i), {referee.address, port}, now), i == shown);
    }
    QCOMPARE(tracker.state()->teams[0].score, 0);
    QCOMPARE(tracker.counts().lost, std::uint64_t(0));
  }

  void oldPacketsOfTheProgramBeforeAreLate() {
    RefereeTracker tracker;
    QVERIFY(shows(tracker, state(12, 50, 3), referee, start));
    QVERIFY(shows(tracker, state(12, 0, 0), sameHost, start + 400ms));
    QVERIFY(tracker.accept(state(12, 51, 3), referee, start + 500ms) ==
            RefereeTracker::Verdict::Late);
    QVERIFY(!tracker.conflict(start + 500ms));
    // One that goes on was not started again: two programs run on that computer.
    QVERIFY(tracker.accept(state(12, 54, 3), referee, start + 2s) ==
            RefereeTracker::Verdict::OtherSender);
    QVERIFY(tracker.conflict(start + 2s));
    QCOMPARE(tracker.state()->teams[0].score, 0);
  }

  // A packet now and then is late; that is no restart as long as newer ones come.
  void newerPacketsEndARunOfLateOnes() {
    RefereeTracker tracker;
    for (int i = 0; i < 20; ++i) {
      const WallTime now = start + i * 500ms;
      QVERIFY(shows(tracker, state(20, 10 + i), referee, now));
      QVERIFY(!shows(tracker, state(20, 8 + i), referee, now + 100ms));
    }
  }
};

PITCHBOARD_TEST(TestRefereeTracker)

}  // namespace tst_referee_tracker

#include "tst_referee_tracker.moc"
