// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The form of all sampled data: a group (a robot, or the match) has columns, and a row is a time
// with a value for every column. The series store keeps rows in memory, a session file on disk.
// Plain values; any thread. Times are seconds of the source.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <telemetry/series/robot_facts.h>

namespace pitchboard::telemetry {

enum class ColumnType : std::uint8_t {
  Int32,    ///< a word of the row
  Float32,  ///< a word of the row, IEEE single
  Float64   ///< a value of the row: truth, derived and received values
};

/// How a value is shown to people.
enum class ColumnKind : std::uint8_t {
  Number,
  Flag,         ///< 0 or 1
  Enumeration,  ///< `labels` has the texts of codes
  Text          ///< `labels` has each text that occurred
};

/// A condition on another column of the same group, or on the column itself.
struct LostWhen {
  std::string column;
  double value = 0.0;  ///< nothing is seen while the column has this value
  bool operator==(const LostWhen&) const = default;
};

struct ColumnInfo {
  std::string name;  ///< "VISION_BALL_DIST"; unique in its group
  ColumnType type = ColumnType::Float64;
  std::string unit;      ///< "cm", "°", "m"; empty if there is none
  std::string category;  ///< "Vision", "Truth": the group in lists
  ColumnKind kind = ColumnKind::Number;
  std::map<std::int32_t, std::string> labels;  ///< texts of codes: 1 → "walk forward, fast"
  /// For a Float64 column: a power of two to which session files round its values, which are then
  /// stored in single precision. 0 keeps every bit.
  double resolution = 0.0;
  /// For a Float32 or Float64 column: when its value is old or was never set. If any of these
  /// holds, views show a gap, while rows keep the value. For example, VISION_BALL_DIST is old while
  /// VISION_LOST is 1, and was never set while it is 0. Empty if the value is always current.
  std::vector<LostWhen> lost = {};
  bool isWhole = false;  ///< a Float64 column of whole numbers (mergedColumns()); not in files
  bool operator==(const ColumnInfo&) const = default;
};

/// A robot, or "match". Whoever makes rows lists the 32-bit columns before the Float64 columns. In
/// memory their order can be any other (column_merge.h).
struct GroupInfo {
  std::string name;  ///< "B1", "match"; unique in a source at any one time
  std::vector<ColumnInfo> columns;
  std::optional<RobotFacts> robot = {};  ///< the robot of the rows, as it is known now
  std::optional<MatchFacts> match = {};  ///< of "match" in a simulated match
  /// Identifies the group for as long as its source exists, while its name and the facts may
  /// change. Empty: the name identifies it.
  std::string id = {};
  bool operator==(const GroupInfo&) const = default;
};

/// Returns the facts about the group's robot, which are all unknown if it has none.
inline const RobotFacts& factsOf(const GroupInfo& group) {
  static const RobotFacts none;
  return group.robot ? *group.robot : none;
}

/// Returns whether both describe the same group of one source.
inline bool isSameGroup(const GroupInfo& a, const GroupInfo& b) {
  return a.id.empty() && b.id.empty() ? a.name == b.name : a.id == b.id;
}

using GroupId = std::uint32_t;

/// A closed range in seconds of the source.
struct TimeRange {
  double begin = 0.0, end = 0.0;
  bool operator==(const TimeRange&) const = default;
};

/// A row: `words` for the Int32 and Float32 columns (bit patterns), `values` for the Float64
/// columns, both in the order of the columns. Time is simulated time, or seconds since Live began.
/// The spans belong to the caller.
struct RowView {
  double time = 0.0;
  std::span<const std::uint32_t> words;
  std::span<const double> values;
};

}  // namespace pitchboard::telemetry
