// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Columns of a group that come, go or change while the group goes on: the columns of all its rows,
// and rows converted to them. Columns are identified by their names, never by their positions. Used
// for rows in memory and in files. Plain values; any thread.

#include <cstdint>
#include <span>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// A group has no more columns than this; further ones are left out.
inline constexpr std::size_t maxMergedColumns = 20'000;

/// Returns the columns of a group that had rows with the columns `before` and now gets rows with
/// `now`. Columns of `before` keep their indices, and new ones follow. A column is described as in
/// `now`. A 32-bit column that is not in both, or that changed its type, becomes a Float64 column,
/// so that NaN can say that a row does not have it. 32-bit columns can therefore stand behind
/// Float64 columns.
std::vector<ColumnInfo> mergedColumns(const std::vector<ColumnInfo>& before,
                                      const std::vector<ColumnInfo>& now);

/// Converts rows to the columns that mergedColumns() made of theirs, or back to them.
class RowMap {
 public:
  /// Leaves rows as they are.
  RowMap() = default;
  RowMap(const std::vector<ColumnInfo>& from, const std::vector<ColumnInfo>& to);

  bool isIdentity() const { return m_isIdentity; }
  /// Converts a row; columns that it does not have become NaN (whole numbers 0). The result refers
  /// to `words` and `values`, or to `row` if nothing has to be converted.
  RowView convert(const RowView& row, std::vector<std::uint32_t>& words,
                  std::vector<double>& values) const;
  /// Returns the index of each column of `from` in `to`; `to.size()` for one that was left out.
  const std::vector<std::size_t>& columns() const { return m_columns; }

 private:
  struct Step {
    ColumnType from, to;
    std::uint32_t fromIndex, toIndex;  // among the words or the values
  };
  bool m_isIdentity = true;
  std::size_t m_words = 0, m_values = 0;  // of a converted row
  std::vector<Step> m_steps;
  std::vector<std::size_t> m_columns;
};

}  // namespace pitchboard::telemetry
