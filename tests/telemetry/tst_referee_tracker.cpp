// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/referee_tracker.h>

#include <QtTest>

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

}  // namespace

class TestRefereeTracker : public QObject {
  Q_OBJECT
 private slots:
  void compatibilityPacketsDoNotFlicker() {
    for (const int version : {8, 9}) {
      RefereeTracker tracker;
      for (int tick = 0; tick < 20; ++tick) {
        const WallTime now = start + tick * 500ms;
        QVERIFY(tracker.accept(state(version, tick), referee, now));
        QVERIFY(!tracker.accept(state(7), sameHost, now + 50ms));
        QCOMPARE(tracker.state()->version, version);
      }
      QCOMPARE(tracker.counts().compatibility, std::uint64_t(20));
      QCOMPARE(tracker.counts().lost, std::uint64_t(0));
      QVERIFY(!tracker.conflict(start + 10s));
    }
  }

  void theLowerVersionFirst() {
    RefereeTracker tracker;
    QVERIFY(tracker.accept(state(7), referee, start));
    QVERIFY(tracker.accept(state(9), referee, start + 50ms));
    QVERIFY(!tracker.accept(state(7), referee, start + 500ms));
  }

  void anOldControllerTakesOverWhenTheNewOneIsGone() {
    RefereeTracker tracker;
    QVERIFY(tracker.accept(state(9), referee, start));
    QVERIFY(!tracker.accept(state(7), referee, start + 2900ms));
    QVERIFY(tracker.accept(state(7), referee, start + 3000ms));
    QCOMPARE(tracker.state()->version, 7);
  }

  void aSecondControllerIsFlaggedAndWaits() {
    RefereeTracker tracker;
    QVERIFY(tracker.accept(state(12, 1, 3), referee, start));
    QVERIFY(!tracker.accept(state(12, 9, 0), other, start + 100ms));
    QVERIFY(tracker.conflict(start + 1s));
    QCOMPARE(tracker.state()->teams[0].score, 3);
    QCOMPARE(*tracker.sender(), referee);
    QVERIFY(!tracker.conflict(start + 4s));
    QVERIFY(tracker.accept(state(12, 10, 0), other, start + 4s));
  }

  void trueDataIsNotARefereeState() {
    RefereeTracker tracker;
    RefereeState secret = state(20);
    secret.magic = {'R', 'G', 'T', 'D'};
    QVERIFY(!tracker.accept(secret, referee, start));
    QVERIFY(!tracker.state());
    QVERIFY(tracker.trueData().has_value());
  }

  void lossAndAge() {
    RefereeTracker tracker;
    QVERIFY(!tracker.age(start));
    QVERIFY(!tracker.timedOut(start));
    tracker.accept(state(12, 254), referee, start);
    tracker.accept(state(12, 255), referee, start + 1s);
    tracker.accept(state(12, 2), referee, start + 2s);
    QCOMPARE(tracker.counts().lost, std::uint64_t(2));
    tracker.accept(state(12, 0), referee, start + 3s);
    QCOMPARE(tracker.counts().lost, std::uint64_t(2));
    QCOMPARE(*tracker.age(start + 5s), Duration(2s));
    QCOMPARE(*tracker.age(start), Duration(0));
    QVERIFY(!tracker.timedOut(start + 12999ms));
    QVERIFY(tracker.timedOut(start + 13s));
  }
};

PITCHBOARD_TEST(TestRefereeTracker)

}  // namespace tst_referee_tracker

#include "tst_referee_tracker.moc"
