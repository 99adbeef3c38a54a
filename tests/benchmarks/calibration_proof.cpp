// SPDX-License-Identifier: GPL-3.0-or-later

// How well calibrate() does: recordings of robots whose numbers are drawn from the prior and hidden
// from it; how often the 95 % intervals hold the hidden number, and whether the calibrated model
// predicts the next 5 s better than the base model.
//   calibration_proof [RECORDINGS] [FIRST-SEED]

#include <cstdio>
#include <cstdlib>

#include "calibration_trial.h"

int main(int argc, char** argv) {
  using namespace pitchboard::link;
  const int recordings = argc > 1 ? std::atoi(argv[1]) : 200;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  CalibrationTally tally;
  for (int i = 0; i < recordings; ++i) {
    const auto trial = playCalibrationTrial(static_cast<std::uint64_t>(first + i));
    if (!trial) {
      std::fprintf(stderr, "error: %s\n", trial.error().text().c_str());
      return 2;
    }
    tally.add(*trial);
    if ((i + 1) % 10 == 0 || i + 1 == recordings) {
      std::fprintf(stderr, "%d of %d\n", i + 1, recordings);
      if ((i + 1) % 50 == 0) tally.print();
    }
  }
  tally.print();
  return 0;
}
