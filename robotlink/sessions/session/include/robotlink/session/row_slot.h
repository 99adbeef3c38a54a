// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A column of recorded rows, found once by name and read from every row. Private to robotlink.

#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string_view>

#include <robotlink/frame/teams.h>
#include <telemetry/formats/meanings.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

struct RowSlot {
  telemetry::ColumnType type = telemetry::ColumnType::Float64;
  int index = -1;  ///< index in the words or the values; -1 if there is no such column

  bool present() const { return index >= 0; }
  /// Returns the value, or NaN if there is no such column.
  double read(const telemetry::RowView& row) const {
    const auto at = static_cast<std::size_t>(index);
    const bool isWord = type != telemetry::ColumnType::Float64;
    if (index < 0 || at >= (isWord ? row.words.size() : row.values.size())) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    if (type == telemetry::ColumnType::Float64) return row.values[at];
    if (type == telemetry::ColumnType::Int32) return std::bit_cast<std::int32_t>(row.words[at]);
    return static_cast<double>(std::bit_cast<float>(row.words[at]));
  }
  double readOr(const telemetry::RowView& row, double fallback) const {
    const double value = read(row);
    return std::isfinite(value) ? value : fallback;
  }
  /// Returns a value from a file as int, limited to its range.
  int readInt(const telemetry::RowView& row, int fallback = 0) const {
    const double value = read(row);
    return std::abs(value) <= 2147483647.0 ? static_cast<int>(value) : fallback;
  }
};

/// Finds the first of these names that the group has; a blackboard and a message may have different
/// names for the same value.
inline RowSlot findSlot(const telemetry::GroupInfo& group,
                        std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    int words = 0, values = 0;
    for (const telemetry::ColumnInfo& column : group.columns) {
      int& index = column.type == telemetry::ColumnType::Float64 ? values : words;
      if (column.name == name) return {column.type, index};
      ++index;
    }
  }
  return {};
}

/// Finds the blackboard variable of this meaning.
inline RowSlot findSlot(const telemetry::GroupInfo& group, telemetry::FieldMeaning meaning) {
  return findSlot(group, {telemetry::info(meaning).variable});
}

/// Returns the colour of a robot's rows; blue if they name none.
inline TeamColor teamOf(const telemetry::GroupInfo& group) {
  return factsOf(group).team.value_or(TeamColor::Blue);
}
/// Returns the key of a simulated robot's rows, for teamsByColour().
inline RobotKey keyOf(const telemetry::GroupInfo& group) {
  return keyOf(sim::RobotIdentity{{}, teamOf(group), factsOf(group).number, false});
}

}  // namespace pitchboard::link
