// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the outputs of a rerun differ from those of the recording: for each variable the stretches
// of time in which they do. Plain values; any thread. Times are seconds of the session.

#include <cstdint>
#include <string>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::link {

/// A stretch of time in which a variable differs.
struct DifferentStretch {
  double begin = 0.0;
  double end = 0.0;       ///< when it was alike again, or the last moment that was compared
  double recorded = 0.0;  ///< the values at its beginning
  double rerun = 0.0;
  double largest = 0.0;  ///< largest distance between them; 0 for codes
  bool operator==(const DifferentStretch&) const = default;
};

struct ComparedVariable {
  static constexpr std::size_t maxStretches = 1000;  ///< that are kept

  telemetry::ColumnInfo column;    ///< name, unit, kind and labels
  double tolerance = 0.0;          ///< in that unit; a larger distance is a difference
  std::uint64_t compared = 0;      ///< values
  std::uint64_t unequal = 0;       ///< values that are not the same to the last bit
  std::uint64_t unchangedToo = 0;  ///< values that differ without any change, too (--same)
  std::uint64_t stretchCount = 0;  ///< stretches, also those that are not kept
  double seconds = 0.0;            ///< duration of all stretches
  double largest = 0.0;            ///< largest distance; 0 for codes
  std::vector<DifferentStretch> stretches{};

  bool differs() const { return stretchCount > 0; }
  bool isCode() const { return column.kind != telemetry::ColumnKind::Number; }
  bool operator==(const ComparedVariable&) const = default;
};

/// An output at a moment.
struct ComparedValue {
  double recorded = 0.0, rerun = 0.0;
  bool counts = false;  ///< false: another process wrote the recorded value, or it is unknown
  bool isSame = false;  ///< to the last bit
};

/// Returns the distance from which on values of this column differ, from its unit; 0 for codes and
/// for units that are not known.
double toleranceOf(const telemetry::ColumnInfo& column);

/// Returns a value with its unit, or the text of a code: "kick right", "35.2 cm".
std::string valueText(const telemetry::ColumnInfo& column, double value);

/// "kick right instead of turn left", "35.2 instead of 25 cm".
std::string differenceText(const ComparedVariable& variable, const DifferentStretch& stretch);

}  // namespace pitchboard::link
