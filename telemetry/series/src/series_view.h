// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What readers see of a group: an immutable state (full chunks, full blocks after them, and as many
// rows of the block being filled as were published when the view was made). Private to the library.

#include <telemetry/series/series_store.h>

#include "series_chunk.h"

namespace pitchboard::telemetry::series {

struct State {
  std::shared_ptr<const Layout> layout;
  std::shared_ptr<const Units> full;       // 4096 rows each; never null
  Units blocks;                            // 64 rows each, at most 63
  std::shared_ptr<const Staging> staging;  // never null
};

class View final : public GroupView {
 public:
  explicit View(std::shared_ptr<const State> state);

  const GroupInfo& info() const override { return m_state->layout->info; }
  std::optional<TimeRange> range() const override;
  std::size_t rows() const override { return m_rows; }
  double rate() const override;
  std::optional<Sample> latest(std::uint32_t column) const override;
  std::optional<Sample> at(std::uint32_t column, double time) const override;
  bool rowAt(double time, double& rowTime, std::vector<std::uint32_t>& words,
             std::vector<double>& values) const override;
  std::optional<double> lastChange(std::uint32_t column) const override;
  void buckets(std::uint32_t column, TimeRange range, std::span<SeriesBucket> out) const override;
  bool samples(std::uint32_t column, TimeRange range, std::vector<Sample>& out,
               std::size_t most) const override;
  SeriesStatistics statistics(std::uint32_t column, TimeRange range) const override;

  /// Number of rows before `time`.
  std::size_t rowsBefore(double time) const;
  /// The row with this number, as it was appended.
  double row(std::size_t number, std::vector<std::uint32_t>& words,
             std::vector<double>& values) const;

 private:
  struct Place {
    const ChunkView* unit = nullptr;
    std::uint32_t row = 0;
  };
  struct Ahead;  // prefetches
  template <bool After>
  struct Search;  // walks forward through ascending times

  // Units are numbered in order of time: chunks, blocks, the staging block.
  std::size_t units() const {
    return m_fullUnits + m_state->blocks.size() + (m_tail.rows > 0 ? 1 : 0);
  }
  const ChunkView& unit(std::size_t number) const;
  std::size_t firstRow(std::size_t unit) const;
  Place place(std::size_t row) const;
  double timeOf(std::size_t row) const;
  /// Below, a column is the slot that Layout::shown() gives for it.
  std::optional<std::uint32_t> slotOf(std::uint32_t column) const {
    const Layout& layout = *m_state->layout;
    return layout.hasColumn(column) ? std::optional(layout.shown(column)) : std::nullopt;
  }

  template <class T>
  T stagedValue(std::uint32_t column, std::uint32_t row) const;
  template <class T>
  T value(std::uint32_t column, std::size_t row) const;
  double number(std::uint32_t column, std::size_t row) const;
  template <class T>
  void minMax(std::uint32_t column, std::size_t begin, std::size_t end, MinMax<T>& out) const;
  template <class T, class Work>
  void runs(std::uint32_t column, std::size_t begin, std::size_t end, const Work& work) const;
  template <class T>
  std::size_t lastChangedRow(std::uint32_t column) const;

  std::shared_ptr<const State> m_state;
  std::size_t m_fullUnits = 0;
  ChunkView m_tail;  // the staging block
  std::size_t m_rows = 0;
};

}  // namespace pitchboard::telemetry::series
