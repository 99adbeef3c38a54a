// SPDX-License-Identifier: GPL-3.0-or-later

// How well calibrate() does: recordings of robots whose numbers are drawn from the prior and hidden
// from it; how often the 95 % intervals hold the hidden number, and whether the calibrated model
// predicts the next 5 s better than the base model.
//   calibration_proof [RECORDINGS] [FIRST-SEED] [SECONDS-OF-KICKS | match [SECONDS]]
// Seeds below 10001 are for the proof; use those from 10001 on while you change calibrate().
// Without kicks (0 seconds) a recording takes half the time. With `match` the robot is the striker
// of match-3v3 instead, for 600 s unless told otherwise, among robots of the base model. Prints a
// table; on stderr every interval, as CSV, and why the other numbers were not estimated.

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "calibration_trial.h"

int main(int argc, char** argv) {
  using namespace pitchboard::link;
  const int recordings = argc > 1 ? std::atoi(argv[1]) : 200;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  const bool match = argc > 3 && std::string_view(argv[3]) == "match";
  const double kickSeconds = argc > 3 ? std::atof(argv[3]) : 240.0;
  const double matchSeconds = argc > 4 ? std::atof(argv[4]) : 600.0;
  CalibrationTally tally;
  std::fprintf(stderr, "seed,key,truth,value,low,high,kept because\n");
  for (int i = 0; i < recordings; ++i) {
    const auto seed = static_cast<std::uint64_t>(first + i);
    const auto trial = match ? playCalibrationTrial(seed, {{"match-3v3", matchSeconds}})
                             : playCalibrationTrial(seed, kickSeconds);
    if (!trial) {
      std::fprintf(stderr, "error: %s\n", trial.error().text().c_str());
      return 2;
    }
    tally.add(*trial);
    for (const CalibratedValue& value : trial->calibration.values) {
      std::fprintf(stderr, "%d,%s,%.6g,%.6g,%.6g,%.6g,\n", first + i, value.key.c_str(),
                   trial->truth(value.key), value.value, value.low, value.high);
    }
    for (const auto& [key, reason] : trial->calibration.kept) {
      std::fprintf(stderr, "%d,%s,%.6g,,,,\"%s\"\n", first + i, key.c_str(), trial->truth(key),
                   reason.c_str());
    }
    std::fprintf(stderr, "%d,prediction,%.6g,%.6g,,,\n", first + i, trial->rms(), trial->rmsBase());
  }
  tally.print();
  return 0;
}
