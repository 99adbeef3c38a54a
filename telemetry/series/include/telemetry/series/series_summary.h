// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A summary of rows: minimum, maximum and last value of every 256 rows, or of fewer before a
// silence, for every column. Session files store it beside their rows, so that a curve over a whole
// day is drawn without reading the day. It is for drawing only, in single precision. Times are
// seconds of the session. Plain values; any thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <telemetry/series/losable.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Up to 64 consecutive buckets of 256 rows, stored by column.
struct SummaryPart {
  static constexpr std::uint32_t defaultRows = 256;  ///< rows of a bucket
  static constexpr std::uint32_t maxBuckets = 64;    ///< buckets of a part
  /// s; a longer silence ends a bucket, so that no curve is drawn across it.
  static constexpr double maxSilence = 10.0;
  struct Column {
    /// A value per bucket, or a single one if all are the same. NaN if there is no number.
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

/// The summary of a group; its parts are in order of time.
struct GroupSummary {
  std::vector<SummaryPart> parts;
  std::uint64_t rows() const;
  std::optional<TimeRange> range() const;
  std::size_t bytes() const;
};

/// Builds the parts from rows as they arrive. One thread at a time.
class SummaryBuilder {
 public:
  explicit SummaryBuilder(const GroupInfo& group);
  /// Adds a row. Returns a part when it is full. `row.time` is ignored.
  std::optional<SummaryPart> add(double time, const RowView& row);
  /// Returns the rest; nothing if no row was added since the last part.
  std::optional<SummaryPart> finish();
  /// Begins a new bucket, because rows of the group go elsewhere for a while. Returns the part if
  /// it is full now.
  std::optional<SummaryPart> closeBucket();

 private:
  /// Columns that stand behind each other in the row, too.
  struct Run {
    bool isWord = false;
    std::size_t column = 0, index = 0, count = 0;
  };
  void read(const RowView& row);
  void beginBucket();
  SummaryPart take();

  std::vector<Run> m_runs;
  std::vector<std::uint32_t> m_intMask;  // of each column: all bits if its words are Int32
  /// A column is unknown in rows with this word, or this value, at `index`.
  template <class T>
  struct Hole {
    std::uint32_t index = 0;
    std::uint32_t column = 0;
    T when{};
  };
  std::vector<Hole<std::uint32_t>> m_wordHoles;
  std::vector<Hole<double>> m_valueHoles;
  std::vector<float> m_min, m_max,
      m_last;  // of the bucket, by column; min above max: no number yet
  std::uint32_t m_rows = 0;
  double m_begin = 0.0, m_end = 0.0;
  SummaryPart m_part;
};

}  // namespace pitchboard::telemetry
