// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a source's data look like wherever they are kept: a group (one robot, or the match) has
// columns, and a row is one time with a value for every column. The series store keeps rows in
// memory, a session file keeps them on disk; both take the same rows. Plain values.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pitchboard::telemetry {

enum class ColumnType : std::uint8_t {
  Int32,    ///< a word of the row
  Float32,  ///< a word of the row, IEEE single
  Float64   ///< a value of the row: truth, derived and received values
};

/// How a value reads to a person.
enum class ColumnKind : std::uint8_t {
  Number,
  Flag,         ///< 0 or 1
  Enumeration,  ///< `labels` has words for codes
  Text          ///< words: `labels` has each one that came; exported as the word
};

struct ColumnInfo {
  std::string name;  ///< "VISION_BALL_DIST"; unique in its group
  ColumnType type = ColumnType::Float64;
  std::string unit;      ///< "cm", "°", "m"; empty where there is none
  std::string category;  ///< "Vision", "Truth": where lists put it
  ColumnKind kind = ColumnKind::Number;
  std::map<std::int32_t, std::string> labels;  ///< words for codes: 1 → "walk forward, fast"
  /// Of a Float64 column: what is worth keeping of its values, a power of two. A session file keeps
  /// them as single precision, rounded to it. 0: every bit.
  double resolution = 0.0;
  /// Of a Float32 column: the 32-bit column of the same group (it may be this one) that tells by
  /// the value `lostWhen` that nothing was seen. Views show a hole there, while the row keeps the
  /// word: VISION_BALL_DIST is the last distance seen, and lost while VISION_LOST is 1. Empty:
  /// always seen.
  std::string lostBy = {};
  double lostWhen = 0.0;
  bool operator==(const ColumnInfo&) const = default;
};

/// One robot, or "match". 32-bit columns stand before the Float64 columns.
struct GroupInfo {
  std::string name;  ///< "B1", "match": unique in a source; presets and files use it
  std::vector<ColumnInfo> columns;
  /// What else is known: "robot" (number of its blackboard), "team", "number" (on the shirt), ...
  std::map<std::string, std::string> attributes;
  bool operator==(const GroupInfo&) const = default;
};

using GroupId = std::uint32_t;

/// From `begin` to `end`, both included, in seconds of the source.
struct TimeRange {
  double begin = 0.0, end = 0.0;
  bool operator==(const TimeRange&) const = default;
};

/// One row: `words` for the Int32 and Float32 columns (bit patterns), `values` for the Float64
/// columns, both in the order of the columns. Time is seconds of the source: simulated time, or
/// seconds since Live began.
struct RowView {
  double time = 0.0;
  std::span<const std::uint32_t> words;
  std::span<const double> values;
};

}  // namespace pitchboard::telemetry
