// SPDX-License-Identifier: GPL-3.0-or-later

// How well calibrate() does: recordings of robots whose numbers are drawn from the prior and hidden
// from it; how often the 95 % intervals hold the hidden number, and whether the calibrated model
// predicts the next 5 s better than the base model.
//   calibration_proof [RECORDINGS] [FIRST-SEED]
// Prints a table; on stderr every interval, as CSV.

#include <cstdio>
#include <cstdlib>

#include "calibration_trial.h"

int main(int argc, char** argv) {
  using namespace pitchboard::link;
  const int recordings = argc > 1 ? std::atoi(argv[1]) : 200;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  CalibrationTally tally;
  std::fprintf(stderr, "seed,key,truth,value,low,high\n");
  for (int i = 0; i < recordings; ++i) {
    const auto trial = playCalibrationTrial(static_cast<std::uint64_t>(first + i));
    if (!trial) {
      std::fprintf(stderr, "error: %s\n", trial.error().text().c_str());
      return 2;
    }
    tally.add(*trial);
    for (const CalibratedValue& value : trial->calibration.values) {
      std::fprintf(stderr, "%d,%s,%.6g,%.6g,%.6g,%.6g\n", first + i, value.key.c_str(),
                   trial->truth(value.key), value.value, value.low, value.high);
    }
    std::fprintf(stderr, "%d,prediction,%.6g,%.6g,,\n", first + i, trial->rms(), trial->rmsBase());
  }
  tally.print();
  return 0;
}
