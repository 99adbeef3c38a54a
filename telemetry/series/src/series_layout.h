// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the values of a group's columns stand in a row, and the sizes everything is cut into.
// A column with holes that other columns tell of (ColumnInfo::lost) is kept twice: as it came,
// for whole rows, and behind all columns with the holes in it, for everything that reads one
// column. Private to the library. Immutable once made.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry::series {

inline constexpr std::uint32_t blockRows = 64;  ///< what the writer collects
inline constexpr std::uint32_t subRows = 16;    ///< smallest unit that has a summary, in raw blocks
inline constexpr std::uint32_t chunkBlocks = 64;  ///< a bit of a word for each
inline constexpr std::uint32_t chunkRows = blockRows * chunkBlocks;
inline constexpr std::uint32_t superBlocks = 8;  ///< blocks below one summary of the next level

struct Slot {
  ColumnType type = ColumnType::Float64;
  std::uint32_t index = 0;  ///< among the words, or among the Float64 values
};

/// A column of which a row can say that nothing was seen. Words are numbered as in a row.
struct Losable {
  struct Flag {
    std::uint32_t word = 0;  ///< the word that tells
    std::uint32_t lost = 0;  ///< its bits where nothing was seen
  };
  std::uint32_t column = 0;  ///< and its word: both have the same number
  std::vector<Flag> flags;   ///< at least one

  bool isLost(std::span<const std::uint32_t> row) const {
    return std::ranges::any_of(flags, [row](const Flag& flag) {
      return flag.word < row.size() && row[flag.word] == flag.lost;
    });
  }
  /// The column's word, or NaN.
  std::uint32_t shown(std::span<const std::uint32_t> row) const {
    return isLost(row) ? std::bit_cast<std::uint32_t>(hole) : row[column];
  }
  static constexpr float hole = std::numeric_limits<float>::quiet_NaN();
};

inline std::vector<Losable> losableColumns(const GroupInfo& group) {
  // 32-bit columns stand first: a column's number is that of its word.
  const auto count = static_cast<std::uint32_t>(
      std::ranges::find(group.columns, ColumnType::Float64, &ColumnInfo::type) -
      group.columns.begin());
  std::vector<Losable> all;
  for (std::uint32_t c = 0; c < count; ++c) {
    const ColumnInfo& column = group.columns[c];
    if (column.type != ColumnType::Float32) continue;
    Losable one{c, {}};
    for (const LostWhen& when : column.lost) {
      const auto word = static_cast<std::uint32_t>(
          std::ranges::find(group.columns, when.column, &ColumnInfo::name) - group.columns.begin());
      if (word >= count) continue;
      const bool isInt = group.columns[word].type == ColumnType::Int32;
      one.flags.push_back(
          {word, isInt ? static_cast<std::uint32_t>(static_cast<std::int32_t>(
                             std::clamp(when.value, -2147483648.0, 2147483647.0)))
                       : std::bit_cast<std::uint32_t>(static_cast<float>(when.value))});
    }
    if (!one.flags.empty()) all.push_back(std::move(one));
  }
  return all;
}

struct Layout {
  explicit Layout(GroupInfo group) : info(std::move(group)), losable(losableColumns(info)) {
    slots.reserve(info.columns.size() + losable.size());
    for (std::uint32_t c = 0; c < info.columns.size(); ++c) {
      const ColumnType type = info.columns[c].type;
      auto& columns = type == ColumnType::Float64 ? valueColumns : wordColumns;
      slots.push_back({type, static_cast<std::uint32_t>(columns.size())});
      columns.push_back(c);
    }
    words = static_cast<std::uint32_t>(wordColumns.size());
    values = static_cast<std::uint32_t>(valueColumns.size());
    for (std::size_t i = 0; i < losable.size(); ++i) {
      const auto slot = static_cast<std::uint32_t>(slots.size());
      slots.push_back({ColumnType::Float32, static_cast<std::uint32_t>(wordColumns.size())});
      wordColumns.push_back(slot);
    }
    keptWords = static_cast<std::uint32_t>(wordColumns.size());
  }
  bool hasColumn(std::uint32_t column) const { return column < info.columns.size(); }
  /// The slot that a query of this column reads.
  std::uint32_t shown(std::uint32_t column) const {
    for (std::uint32_t i = 0; i < losable.size(); ++i) {
      if (losable[i].column == column) {
        return static_cast<std::uint32_t>(info.columns.size()) + i;
      }
    }
    return column;
  }
  GroupInfo info;
  std::vector<Losable> losable;
  std::vector<Slot> slots;  // of the columns, then of the losable ones with their holes
  std::vector<std::uint32_t> wordColumns, valueColumns;  // slot of each word, of each value
  std::uint32_t words = 0, values = 0;                   // of one row
  std::uint32_t keptWords = 0;                           // of one row, with those that have holes
};

/// Calls `work` with a value of the type that a column holds.
template <class Work>
decltype(auto) withType(ColumnType type, Work&& work) {
  switch (type) {
    case ColumnType::Int32:
      return work(std::int32_t{});
    case ColumnType::Float32:
      return work(float{});
    case ColumnType::Float64:
      break;
  }
  return work(double{});
}

template <class T>
using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

template <class T>
Bits<T> bitsOf(T value) {
  return std::bit_cast<Bits<T>>(value);
}

}  // namespace pitchboard::telemetry::series
