// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A coarse picture of rows that are not in memory: extremes of every 256 rows, for every column.
// A session file holds them beside its rows, so that a curve over a whole day is drawn without
// reading the day. Single precision: it is for drawing. Seconds of the session. Plain values.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Neighbouring parts of 256 rows; column by column.
struct SummaryPart {
  static constexpr std::uint32_t usualRows = 256;   ///< in one bucket
  static constexpr std::uint32_t mostBuckets = 64;  ///< in one part
  struct Column {
    /// One value for each bucket, or one for all of them when they are the same. NaN: no number.
    std::vector<float> min, max, last;
    bool operator==(const Column&) const = default;
  };
  std::vector<double> begin, end;  ///< times of the first and the last row of each bucket
  std::vector<std::uint32_t> rows;
  std::vector<Column> columns;

  std::size_t buckets() const { return begin.size(); }
  std::size_t bytes() const;
  bool operator==(const SummaryPart&) const = default;
};

/// Of one group; parts in order of time.
struct GroupSummary {
  std::vector<SummaryPart> parts;
  std::uint64_t rows() const;
  std::optional<TimeRange> range() const;
  std::size_t bytes() const;
};

/// Makes parts of rows as they come. One thread.
class SummaryBuilder {
 public:
  explicit SummaryBuilder(const GroupInfo& group);
  /// A part, when it is full. `row.time` is not looked at.
  std::optional<SummaryPart> add(double time, const RowView& row);
  /// What there is so far; nothing when there is nothing.
  std::optional<SummaryPart> finish();

 private:
  struct Extremes {
    float min, max, last;
  };
  void closeBucket();
  SummaryPart take();

  std::vector<ColumnType> m_types;
  struct Losable {
    std::size_t column, flag;  // words of a row
    std::uint32_t lost;
  };
  std::vector<Losable> m_losable;
  std::vector<Extremes> m_now;
  std::uint32_t m_rows = 0;
  double m_begin = 0.0, m_end = 0.0;
  SummaryPart m_part;
};

}  // namespace pitchboard::telemetry
