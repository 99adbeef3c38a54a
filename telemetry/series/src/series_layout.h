// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the values of a group's columns stand in a row, and the sizes everything is cut into.
// A column with holes that other columns tell of (ColumnInfo::lost) is kept twice: as it came,
// for whole rows, and behind all columns with the holes in it, for everything that reads one
// column. Private to the library. Immutable once made.

#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <telemetry/series/losable.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry::series {

inline constexpr std::uint32_t blockRows = 64;  ///< what the writer collects
inline constexpr std::uint32_t subRows = 16;    ///< smallest unit that has a summary, in raw blocks
inline constexpr std::uint32_t chunkBlocks = 64;  ///< a bit of a word for each
inline constexpr std::uint32_t chunkRows = blockRows * chunkBlocks;
inline constexpr std::uint32_t superBlocks = 8;  ///< blocks below one summary of the next level

struct Layout {
  explicit Layout(GroupInfo group)
      : info(std::move(group)), losable(losableColumns(info)), slots(slotsOf(info.columns)) {
    slots.reserve(info.columns.size() + losable.size());
    for (std::uint32_t slot = 0; slot < slots.size(); ++slot) columnsOf(slot).push_back(slot);
    words = static_cast<std::uint32_t>(wordColumns.size());
    values = static_cast<std::uint32_t>(valueColumns.size());
    for (const Losable& one : losable) {
      const auto slot = static_cast<std::uint32_t>(slots.size());
      slots.push_back({one.slot.type, 0});
      auto& columns = columnsOf(slot);
      slots.back().index = static_cast<std::uint32_t>(columns.size());
      columns.push_back(slot);
    }
    keptWords = static_cast<std::uint32_t>(wordColumns.size());
    keptValues = static_cast<std::uint32_t>(valueColumns.size());
  }
  bool hasColumn(std::uint32_t column) const { return column < info.columns.size(); }
  /// The slot that a query of this column reads.
  std::uint32_t shown(std::uint32_t column) const {
    const auto found = std::ranges::lower_bound(losable, column, {}, &Losable::column);
    if (found == losable.end() || found->column != column) return column;
    return static_cast<std::uint32_t>(info.columns.size()) +
           static_cast<std::uint32_t>(found - losable.begin());
  }
  GroupInfo info;
  std::vector<Losable> losable;
  std::vector<Slot> slots;  // of the columns, then of the losable ones with their holes
  std::vector<std::uint32_t> wordColumns, valueColumns;  // slot of each word, of each value
  std::uint32_t words = 0, values = 0;                   // of one row
  std::uint32_t keptWords = 0, keptValues = 0;           // of one row, with those that have holes

 private:
  std::vector<std::uint32_t>& columnsOf(std::uint32_t slot) {
    return slots[slot].type == ColumnType::Float64 ? valueColumns : wordColumns;
  }
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
