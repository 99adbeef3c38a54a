// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs a recorded trace of the published simulator through our `published` model and compares every
// value of every frame. Format of a trace: docs/conformance.md (a JSON file with the initial state
// and a schedule, and the recorded rows beside it as .csv.gz).

#include <string>

#include <base/result.h>

namespace pitchboard::link {

struct ConformanceReport {
  std::string name;
  int rows = 0;                   ///< compared, the initial state included
  long long values = 0;           ///< compared
  double largestDeviation = 0.0;  ///< of the doubles: cm, degrees, cm per frame
  std::string largestWhere;       ///< "frame 12, r1_x"; empty when nothing deviates
  long long differences = 0;      ///< doubles off by more than 1e-9, other values not identical
  std::string firstDifference;    ///< "frame 12, r1_x: 320.5 recorded, 320.6 computed"

  bool conforms() const { return differences == 0; }
};

/// Largest deviation of a double that counts as the same.
inline constexpr double conformanceTolerance = 1e-9;

/// `jsonPath` names the trace; the rows are read from the same path with .csv.gz for .json. Fails
/// when a file cannot be read or does not follow the format; a difference is not a failure.
Result<ConformanceReport> runConformance(const std::string& jsonPath);

}  // namespace pitchboard::link
