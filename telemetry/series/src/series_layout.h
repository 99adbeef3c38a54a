// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the values of a group's columns stand in a row, and the sizes everything is cut into.
// Private to the library. Immutable once made.

#include <bit>
#include <cstdint>
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

struct Layout {
  explicit Layout(GroupInfo group) : info(std::move(group)) {
    slots.reserve(info.columns.size());
    for (std::uint32_t c = 0; c < info.columns.size(); ++c) {
      const ColumnType type = info.columns[c].type;
      auto& columns = type == ColumnType::Float64 ? valueColumns : wordColumns;
      slots.push_back({type, static_cast<std::uint32_t>(columns.size())});
      columns.push_back(c);
    }
    words = static_cast<std::uint32_t>(wordColumns.size());
    values = static_cast<std::uint32_t>(valueColumns.size());
  }
  GroupInfo info;
  std::vector<Slot> slots;                               // of the columns
  std::vector<std::uint32_t> wordColumns, valueColumns;  // column of each word, of each value
  std::uint32_t words = 0, values = 0;                   // of one row
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
