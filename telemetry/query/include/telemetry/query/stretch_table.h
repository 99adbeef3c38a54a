// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table that describes a stretch: what `pitchboard-cli statistics` prints and the panel
// Statistics shows. A line for each variable or expression and robot, and one for each state of a
// code. docs/statistics.md has the formulas. One thread at a time. Times are s of the session,
// values in the unit of the line.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/query/stretch.h>
#include <telemetry/statistics/curve_statistics.h>

namespace pitchboard::telemetry {

struct StretchQuestion {
  struct Text {
    std::string expression, name;  ///< the name is that of the table
  };
  std::vector<Text> texts;
  std::string condition;            ///< only samples at which it holds; empty: all
  std::vector<std::string> robots;  ///< that `each` stands for; all if empty
  std::string against;              ///< expression of the curve to compare with; empty: none
  double maxDelay = 1.0;            ///< s
  std::size_t bins = 0;             ///< of the histogram; 0: none
  /// Expressions for a place (m), and the squares over which values are averaged; empty: no map.
  std::string placeX = {}, placeY = {};
  MapGrid grid = {};
};

struct StretchLine {
  std::string session{};  ///< left to the caller
  std::string robot{}, variable{}, unit{};
  std::optional<StateShare> state{};  ///< the line describes one value of a code
  std::string label{};                ///< of the state; may be empty
  bool isCode = false;                ///< values are codes: states follow, numbers say nothing
  CurveSummary summary{};
  std::optional<CurveError> error{};
  std::optional<CurveCorrelation> correlation{};
  std::vector<std::size_t> counts{};  ///< histogram from the smallest to the largest value
  std::optional<ValueMap> map{};      ///< of numbers, if a place was asked for and is known
};

struct StretchTable {
  std::vector<StretchLine> lines{};
  struct Problem {
    std::string name;  ///< of StretchQuestion::Text
    Error error;
  };
  std::vector<Problem> problems{};  ///< texts without lines, and comparisons that make no sense
};

/// Describes closed ranges, which are in order of time. `progress` is called from time to time with
/// the share that is done (0 to 1). Fails if the condition or the other curve is wrong, and with
/// Conflict after `progress` returned false.
Result<StretchTable> describeStretch(const QueryRows& rows, const StretchQuestion& question,
                                     std::span<const TimeRange> ranges,
                                     const std::function<bool(double)>& progress = {});

/// A column of numbers; NaN where a line has none.
struct StretchColumn {
  std::string name;  ///< in files: "mean_95_low"
  double (*of)(const StretchLine&);
};
/// Returns all columns; those of errors only if `isCompared`.
std::vector<StretchColumn> stretchColumns(bool isCompared);

/// Returns a number of a table for other programs: 12 digits; empty if it is unknown.
std::string stretchNumber(double value);
/// Returns the lines as CSV, with a heading. `hasCounts`: with the histogram.
std::string stretchCsv(std::span<const StretchLine> lines, bool isCompared, bool hasCounts);

}  // namespace pitchboard::telemetry
