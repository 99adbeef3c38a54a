// SPDX-License-Identifier: GPL-3.0-or-later
// Rollouts against whole cognition from the same moments of a match: a small part of what
// tests/benchmarks/rollout_agreement measures by hand (docs/rollouts.md has the figures).
#include <QtTest>

#include <numeric>

#include "../support/rollout_agreement.h"

namespace tst_rollout_agreement {

using namespace pitchboard;
using namespace pitchboard::tests;

class TestRolloutAgreement : public QObject {
  Q_OBJECT
 private slots:
  void distanceOfDistributions() {
    QCOMPARE(kolmogorovSmirnov({1, 2, 3}, {1, 2, 3}), 0.0);
    QCOMPARE(kolmogorovSmirnov({0, 0}, {1, 1}), 1.0);
    QCOMPARE(kolmogorovSmirnov({0, 1, 2, 3}, {2, 3, 4, 5}), 0.5);
    QCOMPARE(kolmogorovSmirnov({0, 0, 0, 1}, {0, 0, 1, 1}), 0.25);
  }

  /// Restored with another seed a match goes another way; with the same one, the same.
  void wholeCognitionRepeats() {
    auto match = agreementMatch(3);
    for (int tick = 0; tick < 600; ++tick) match->tick();
    const Situation situation = situationOf(*match);
    const Endings first = playWhole(*match, situation, 1, 3, 2.0);
    QCOMPARE(playWhole(*match, situation, 1, 3, 2.0).x, first.x);
    QVERIFY(playWhole(*match, situation, 11, 3, 2.0).y != first.y);
  }

  /// The ball of three situations is where whole cognition has it, nearly.
  void rolloutsAgreeWithWholeCognition() {
    constexpr int runs = 80;
    const link::Scenario scenario = agreementScenario();
    auto rollouts = rollout::Rollouts::create(link::rolloutStartOf(scenario).setup).value();
    double sum = 0.0;
    for (const std::uint64_t seed : {1, 2, 3}) {
      auto match = agreementMatch(seed);
      for (std::uint64_t tick = 0; tick < 600 * seed; ++tick) match->tick();
      const Situation situation = situationOf(*match);
      QVERIFY(isOnField(situation));
      const Endings whole = playWhole(*match, situation, 1000, runs, 8.0);
      const Endings fast =
          playRollouts(rollouts, scenario.settings.field, situation, 1000, runs, 8.0);
      const Distances d = distancesOf(whole, fast);
      for (const double one : d.all()) sum += one;
      QVERIFY2(d.goals <= 0.25, qPrintable(QString::number(d.goals)));
    }
    // Two samples of one distribution are 0.15 apart on average for a smooth quantity.
    QVERIFY2(sum / 12.0 <= 0.25, qPrintable(QString::number(sum / 12.0)));
  }
};

PITCHBOARD_TEST(TestRolloutAgreement)

}  // namespace tst_rollout_agreement

#include "tst_rollout_agreement.moc"
