// SPDX-License-Identifier: GPL-3.0-or-later
// Counters of 8, 16 and 32 bits: what a robot sends is counted here without them, and compared.

#include <QtTest>

#include <telemetry/monitor/sequence_stats.h>

namespace tst_sequence_stats {

using pitchboard::telemetry::SequenceStats;
using Step = SequenceStats::Step;

class TestSequenceStats : public QObject {
  Q_OBJECT

 private slots:
  void everyFourthIsMissing_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("reported");
    QTest::addColumn<qint64>("first");
    for (const int bits : {8, 16, 32}) {
      for (const int reported : {0, bits}) {
        // So that the counter goes over its end in the middle.
        const qint64 end = qint64{1} << bits;
        QTest::addRow("%d bits, %s", bits, reported == 0 ? "inferred" : "said")
            << bits << reported << end - 600 % end;
      }
    }
    QTest::newRow("0 to 255 again and again") << 8 << 0 << qint64{0};
  }
  void everyFourthIsMissing() {
    QFETCH(int, bits);
    QFETCH(int, reported);
    QFETCH(qint64, first);
    SequenceStats stats(reported);
    std::uint64_t sent = 0;
    for (qint64 i = 0; i < 1200; ++i) {
      if (i % 4 == 2) continue;
      const Step step = stats.add((first + i) % (qint64{1} << bits));
      QVERIFY(step == (i == 0 ? Step::First : i % 4 == 3 ? Step::Gap : Step::Next));
      ++sent;
    }
    QCOMPARE(sent, std::uint64_t{900});
    QCOMPARE(stats.received(), sent);
    QCOMPARE(stats.lost(), std::uint64_t{300});
    QCOMPARE(stats.loss(), 0.25);
    QCOMPARE(stats.duplicates() + stats.late() + stats.restarts(), std::uint64_t{0});
  }

  void lateAcrossTheEnd() {
    SequenceStats stats;
    for (int i = 0; i < 256; ++i) {
      if (i != 254) stats.add(i);
    }
    QCOMPARE(stats.lost(), std::uint64_t{1});
    QVERIFY(stats.add(0) == Step::Next);
    QVERIFY(stats.add(1) == Step::Next);
    QVERIFY(stats.add(254) == Step::Late);
    QCOMPARE(stats.lost(), std::uint64_t{0});
    QVERIFY(stats.add(254) == Step::Duplicate);
    QVERIFY(stats.add(255) == Step::Duplicate);
    QVERIFY(stats.add(2) == Step::Next);
    QCOMPARE(stats.late(), std::uint64_t{1});
    QCOMPARE(stats.duplicates(), std::uint64_t{2});
    QCOMPARE(stats.received(), std::uint64_t{259});
  }

  void olderThanTheFirst() {
    SequenceStats stats;
    QVERIFY(stats.add(5) == Step::First);
    QVERIFY(stats.add(3) == Step::Late);
    QVERIFY(stats.add(4) == Step::Late);
    QVERIFY(stats.add(6) == Step::Next);
    QCOMPARE(stats.lost(), std::uint64_t{0});  // nobody had missed them
    QCOMPARE(stats.received(), std::uint64_t{4});
  }

  void aRobotThatStartsAgain() {
    SequenceStats stats;
    for (int i = 100; i < 150; ++i) stats.add(i);
    QVERIFY(stats.add(0) == Step::Restart);
    QVERIFY(stats.add(1) == Step::Next);
    QVERIFY(stats.add(50'000, true) == Step::Restart);
    QVERIFY(stats.add(49'999) == Step::Late);
    QCOMPARE(stats.restarts(), std::uint64_t{2});
    QCOMPARE(stats.lost(), std::uint64_t{0});
    // 32 bits: 0 after a few hundred is no wrap.
    SequenceStats wide(32);
    for (int i = 0; i < 300; ++i) wide.add(i);
    QVERIFY(wide.add(0) == Step::Restart);
  }

  void aLongGapOfOneSenderIsALoss() {
    SequenceStats stats(32);
    stats.add(10);
    QVERIFY(stats.add(1030) == Step::Gap);
    QCOMPARE(stats.lost(), std::uint64_t{1019});
    QVERIFY(stats.add(60'000) == Step::Gap);
    QCOMPARE(stats.restarts(), std::uint64_t{0});
    // A counter with any number in it is none.
    QVERIFY(stats.add(3'000'000'000) == Step::Restart);
    // Another program may begin anywhere.
    SequenceStats other(32);
    other.add(10);
    QVERIFY(other.add(1030, true) == Step::Restart);
    QCOMPARE(other.lost(), std::uint64_t{0});
  }

  void aSignedCounterRunsOver() {
    SequenceStats stats;
    stats.add(std::numeric_limits<std::int32_t>::max());
    QVERIFY(stats.add(std::numeric_limits<std::int32_t>::min()) == Step::Next);
    QVERIFY(stats.add(std::numeric_limits<std::int32_t>::min() + 2) == Step::Gap);
    QCOMPARE(stats.lost(), std::uint64_t{1});
  }

  void aGapWiderThanTheAssumedCounter() {
    // 10 to 240 may be 230 more or, of 8 bits, 26 less: nothing came before 10, so it is more.
    SequenceStats stats;
    stats.add(10);
    QVERIFY(stats.add(240) == Step::Gap);
    QCOMPARE(stats.lost(), std::uint64_t{229});
  }
};

PITCHBOARD_TEST(TestSequenceStats)

}  // namespace tst_sequence_stats

#include "tst_sequence_stats.moc"
