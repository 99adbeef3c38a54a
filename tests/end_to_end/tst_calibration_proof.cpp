// SPDX-License-Identifier: GPL-3.0-or-later

// How often the intervals of calibrate() hold numbers that were hidden from it, and whether its
// model predicts better than the base model. The program calibration_proof plays more recordings
// (docs/calibrate.md).

#include <QtTest>

#include "../support/calibration_trial.h"

namespace tst_calibration_proof {

class TestCalibrationProof : public QObject {
  Q_OBJECT

 private slots:
  void intervalsHoldHiddenNumbers() {
    using namespace pitchboard::link;
    constexpr int trials = 16;
    CalibrationTally tally;
    for (std::uint64_t seed = 20001; seed < 20001 + trials; ++seed) {
      const auto trial = playCalibrationTrial(seed);
      QVERIFY2(trial.has_value(), trial ? "" : trial.error().text().c_str());
      tally.add(*trial);
    }
    tally.print();
    QVERIFY(tally.intervals() > 20 * trials);
    // Of some 400 intervals, of which those of a recording depend on each other.
    QVERIFY(tally.covered() >= 0.9 * tally.intervals());
    QVERIFY(tally.covered() <= 0.99 * tally.intervals());
    QVERIFY(tally.predicted() >= trials - 1);
    QVERIFY(tally.better() >= tally.predicted() - 1);
  }
};

}  // namespace tst_calibration_proof

QTEST_GUILESS_MAIN(tst_calibration_proof::TestCalibrationProof)

#include "tst_calibration_proof.moc"
