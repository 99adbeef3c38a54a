// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/random.h>
#include <base/random_batch.h>

#include <QtTest>
#include <cmath>
#include <set>

#include "random_loops.h"

namespace tst_random {

using namespace pitchboard;

class TestRandom : public QObject {
  Q_OBJECT

 private slots:
  void sameKeySameNumbers() {
    CounterRandom a(7, 3, NoiseStream::Motion, 99);
    CounterRandom b(7, 3, NoiseStream::Motion, 99);
    for (int i = 0; i < 100; ++i) QCOMPARE(a.uniform(), b.uniform());
  }

  void everyPartOfTheKeyCounts() {
    std::set<double> first;
    int keys = 0;
    const auto draw = [&](std::uint64_t seed, int robot, NoiseStream stream, std::uint64_t tick) {
      first.insert(CounterRandom(seed, robot, stream, tick).uniform());
      ++keys;
    };
    draw(1, 1, NoiseStream::Motion, 0);
    draw(2, 1, NoiseStream::Motion, 0);
    draw(1ULL << 40, 1, NoiseStream::Motion, 0);
    draw(1, 2, NoiseStream::Motion, 0);
    draw(1, 1, NoiseStream::Kick, 0);
    draw(1, 1, NoiseStream::Motion, 1);
    draw(1, 1, NoiseStream::Motion, 1ULL << 32);
    draw(1, 1, NoiseStream::Motion, 1ULL << 40);
    QCOMPARE(static_cast<int>(first.size()), keys);
  }

  void blocksOfOneTickDoNotMeetTheNextTick() {
    // 8 draws are four blocks; none of them may come back at another tick.
    std::set<double> all;
    for (std::uint64_t tick = 0; tick < 1000; ++tick) {
      CounterRandom random(1, 1, NoiseStream::Imu, tick);
      for (int i = 0; i < 8; ++i) all.insert(random.uniform());
    }
    QCOMPARE(all.size(), std::size_t{8000});
  }

  void uniformIsUniform() {
    constexpr int draws = 100000;
    double sum = 0.0;
    int lower[10] = {};
    for (int i = 0; i < draws; ++i) {
      const double u =
          CounterRandom(5, 1, NoiseStream::Landmarks, static_cast<std::uint64_t>(i)).uniform();
      QVERIFY(u >= 0.0 && u < 1.0);
      sum += u;
      ++lower[static_cast<int>(u * 10)];
    }
    QVERIFY(std::abs(sum / draws - 0.5) < 5 * std::sqrt(1.0 / 12 / draws));
    for (const int count : lower) {
      QVERIFY(std::abs(count - draws / 10) < 5 * std::sqrt(draws * 0.09));
    }
  }

  void normalHasItsMeanAndSigma() {
    constexpr int draws = 100000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < draws; ++i) {
      CounterRandom random(5, 1, NoiseStream::Motion, static_cast<std::uint64_t>(i));
      const double v = random.normal(3.0, 2.0);
      sum += v;
      squares += (v - 3.0) * (v - 3.0);
    }
    QVERIFY(std::abs(sum / draws - 3.0) < 5 * 2.0 / std::sqrt(draws));
    QVERIFY(std::abs(std::sqrt(squares / draws) - 2.0) < 5 * 2.0 / std::sqrt(2.0 * draws));
  }

  // Whatever is drawn in which order, and however many robots there are.
  void aBatchHasTheNumbersOfEachRobot() {
    RandomBatch many;
    for (int robots = 1; robots <= 22; ++robots) {
      std::vector<int> numbers;
      for (int i = 0; i < robots; ++i) numbers.push_back(3 * i + 1);
      for (std::uint64_t tick = (1ULL << 33) - 50; tick < (1ULL << 33) + 50; ++tick) {
        const std::uint64_t seed = 0x123456789ABCDEF0ULL + tick;
        const int count = 1 + static_cast<int>(tick % 7);
        many.make(seed, NoiseStream::BallVision, tick, numbers, count);
        for (int i = 0; i < robots; ++i) {
          auto draws = many.of(static_cast<std::size_t>(i));
          CounterRandom one(seed, numbers[static_cast<std::size_t>(i)], NoiseStream::BallVision,
                            tick);
          QCOMPARE(draws.normal(4.0, 0.0), one.normal(4.0, 0.0));
          for (int k = 0; k < count; ++k) {
            if ((tick + static_cast<std::uint64_t>(k)) % 3 == 0)
              QCOMPARE(draws.uniform(), one.uniform());
            else
              QCOMPARE(draws.normal(0.5, 2.0), one.normal(0.5, 2.0));
          }
        }
      }
    }
  }

  void aBatchHasTheNumbersOfManyWorlds() {
    const std::vector<RandomBatch::Tick> ticks{{1, 5}, {2, 5}, {1, 1ULL << 34}, {1ULL << 40, 7}};
    const std::vector<int> robots{4, 9, 2};
    RandomBatch many;
    many.make(ticks, NoiseStream::Imu, robots, 3);
    for (std::size_t i = 0; i < ticks.size() * robots.size(); ++i) {
      const RandomBatch::Tick& tick = ticks[i / robots.size()];
      CounterRandom one(tick.seed, robots[i % robots.size()], NoiseStream::Imu, tick.tick);
      auto draws = many.of(i);
      for (int k = 0; k < 3; ++k) QCOMPARE(draws.normal(0.0, 1.0), one.normal(0.0, 1.0));
    }
  }

  void everySimdLevelGivesTheSameBits_data() {
    QTest::addColumn<int>("level");
    QTest::newRow("avx2") << static_cast<int>(SimdLevel::Avx2);
    QTest::newRow("avx512") << static_cast<int>(SimdLevel::Avx512);
  }
  void everySimdLevelGivesTheSameBits() {
    QFETCH(int, level);
    const random_loops::Loops* wide = random_loops::loopsOf(static_cast<SimdLevel>(level));
    if (!wide) QSKIP("this processor or compiler lacks this SIMD level");
    const random_loops::Loops& narrow = *random_loops::loopsOf(SimdLevel::Baseline);
    constexpr std::size_t counters = 101;
    std::vector<std::uint32_t> seedLow(counters), tickLow(counters, 8), high(counters);
    std::vector<std::uint32_t> seedHigh(counters, 1), robot(counters);
    for (std::size_t i = 0; i < counters; ++i) {
      seedLow[i] = static_cast<std::uint32_t>(77 * i);
      high[i] = static_cast<std::uint32_t>(i * i);
      robot[i] = static_cast<std::uint32_t>(i + 1);
    }
    const auto all = [&](const random_loops::Loops& loops) {
      std::vector<double> values(4 * counters);
      double* const normals = values.data() + 2 * counters;
      loops.fillWholes(
          {seedLow.data(), seedHigh.data(), tickLow.data(), high.data(), robot.data(), 2},
          values.data(), counters);
      loops.fillNormals(values.data(), normals, 2 * counters);
      return values;
    };
    QCOMPARE(all(*wide), all(narrow));
  }

  void withoutSigmaNoNumberIsUsed() {
    CounterRandom a(1, 1, NoiseStream::Motion, 1);
    CounterRandom b(1, 1, NoiseStream::Motion, 1);
    QCOMPARE(a.normal(4.0, 0.0), 4.0);
    QCOMPARE(a.uniform(), b.uniform());
  }
};

PITCHBOARD_TEST(TestRandom)

}  // namespace tst_random

#include "tst_random.moc"
