// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a value of a row is unknown: the rule of ColumnInfo::lost, for everything that reads rows
// (views of the store, summaries of sessions, metrics). Plain values; any thread.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Where a column stands in a row.
struct Slot {
  ColumnType type = ColumnType::Float64;
  std::uint32_t index = 0;  ///< among the words, or among the Float64 values
};

/// Returns the places of all columns.
inline std::vector<Slot> slotsOf(const std::vector<ColumnInfo>& columns) {
  std::uint32_t words = 0, values = 0;
  std::vector<Slot> out;
  out.reserve(columns.size());
  for (const ColumnInfo& column : columns) {
    std::uint32_t& next = column.type == ColumnType::Float64 ? values : words;
    out.push_back({column.type, next++});
  }
  return out;
}

/// A column with a value that can be unknown.
struct Losable {
  struct Flag {
    Slot slot;           ///< what tells it
    std::uint32_t word;  ///< its bits where nothing was seen,
    double value;        ///< or its value
  };
  std::uint32_t column = 0;  ///< of the group
  Slot slot;                 ///< of the column
  std::vector<Flag> flags;   ///< at least one

  bool isLost(const RowView& row) const {
    return std::ranges::any_of(flags, [&row](const Flag& flag) {
      if (flag.slot.type == ColumnType::Float64) {
        return flag.slot.index < row.values.size() && row.values[flag.slot.index] == flag.value;
      }
      return flag.slot.index < row.words.size() && row.words[flag.slot.index] == flag.word;
    });
  }
};

/// Returns the columns of a group whose value can be unknown, in their order.
inline std::vector<Losable> losableColumns(const GroupInfo& group) {
  const std::vector<Slot> places = slotsOf(group.columns);
  std::vector<Losable> all;
  for (std::uint32_t c = 0; c < places.size(); ++c) {
    const ColumnInfo& column = group.columns[c];
    if (column.type == ColumnType::Int32) continue;
    Losable one{c, places[c], {}};
    for (const LostWhen& when : column.lost) {
      const auto told = static_cast<std::size_t>(
          std::ranges::find(group.columns, when.column, &ColumnInfo::name) - group.columns.begin());
      if (told >= places.size()) continue;
      const bool isInt = places[told].type == ColumnType::Int32;
      const auto whole =
          static_cast<std::int32_t>(std::clamp(when.value, -2147483648.0, 2147483647.0));
      one.flags.push_back({places[told],
                           isInt ? static_cast<std::uint32_t>(whole)
                                 : std::bit_cast<std::uint32_t>(static_cast<float>(when.value)),
                           when.value});
    }
    if (!one.flags.empty()) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace pitchboard::telemetry
