// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/random.h>

#include <QtTest>
#include <cmath>
#include <set>

using namespace pitchboard;

class TestRandom : public QObject {
  Q_OBJECT

 private slots:
  void sameKeySameDraws() {
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

  void noSigmaDrawsNothing() {
    CounterRandom a(1, 1, NoiseStream::Motion, 1);
    CounterRandom b(1, 1, NoiseStream::Motion, 1);
    QCOMPARE(a.normal(4.0, 0.0), 4.0);
    QCOMPARE(a.uniform(), b.uniform());
  }
};

QTEST_GUILESS_MAIN(TestRandom)
#include "tst_random.moc"
