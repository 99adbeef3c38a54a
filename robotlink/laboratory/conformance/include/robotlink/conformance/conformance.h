// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a recorded trace of the published simulator with our `published` model and compares every
// value of every frame. A trace is a JSON file with the initial state and a schedule, with the
// recorded rows beside it as .csv.gz (docs/conformance.md). Any thread.

#include <string>

#include <base/result.h>

namespace pitchboard::link {

struct ConformanceReport {
  std::string name;
  int rows = 0;                   ///< compared rows, including the initial state
  long long values = 0;           ///< compared values
  double largestDeviation = 0.0;  ///< of doubles, in cm, degrees or cm per frame
  std::string largestWhere;       ///< such as "frame 12, r1_x"; empty if nothing deviates
  long long differences = 0;      ///< doubles beyond the tolerance, other values not identical
  std::string firstDifference;    ///< such as "frame 12, r1_x: 320.5 recorded, 320.6 computed"

  bool conforms() const { return differences == 0; }
};

/// Doubles that differ by at most this count as equal.
inline constexpr double conformanceTolerance = 1e-9;

/// Compares the trace at `jsonPath`, whose rows are in the file with .csv.gz instead of .json.
/// Fails if a file cannot be read or is invalid; a difference is not an error.
Result<ConformanceReport> runConformance(const std::string& jsonPath);

}  // namespace pitchboard::link
