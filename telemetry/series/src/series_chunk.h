// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows of one group: the block that the writer fills row by row (Staging), and what full blocks
// become (Chunk, column by column). Private to the library.

#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "series_column.h"

namespace pitchboard::telemetry::series {

/// The newest rows, row by row. The writer fills a row and then publishes it; a published row never
/// changes, so readers need no lock. A rewind makes a new one.
struct Staging {
  explicit Staging(const Layout& layout);
  /// The row after the last one; false when the block is now full.
  bool put(const RowView& row, const Layout& layout);

  std::atomic<std::uint32_t> rows{0};
  std::unique_ptr<double[]> times;         // [64]
  std::unique_ptr<std::uint32_t[]> words;  // [64][layout.keptWords]
  std::unique_ptr<double[]> values;        // [64][layout.keptValues]
  std::size_t bytes = 0;
};

struct ChunkView;

/// 64 rows (one block) or 4096 rows (64 blocks); immutable.
class Chunk {
 public:
  static std::shared_ptr<const Chunk> ofStaging(const Staging& full, const Layout& layout);
  static std::shared_ptr<const Chunk> join(std::span<const ChunkView> blocks, const Layout& layout);

  /// The same rows, until now of `from`, with the columns that mergedColumns() made of it. Columns
  /// that they did not have are holes.
  std::shared_ptr<const Chunk> converted(const Layout& from, const Layout& to) const;

  std::uint32_t blocks() const { return static_cast<std::uint32_t>(m_times.size()) / blockRows; }
  std::uint32_t rows() const { return static_cast<std::uint32_t>(m_times.size()); }
  const double* times() const { return m_times.data(); }
  const Column* columns() const { return m_columns.data(); }
  std::size_t bytes() const { return m_bytes; }

 private:
  void count(const Layout& layout);
  std::vector<double> m_times;
  std::vector<Column> m_columns;  // of the layout's slots
  std::size_t m_bytes = 0;
};

/// A chunk, or the published part of the staging block, with what a query needs of it in one cache
/// line: a query over millions of rows waits for memory and for nothing else.
struct ChunkView {
  ChunkView() = default;
  explicit ChunkView(std::shared_ptr<const Chunk> of)
      : times(of->times()),
        columns(of->columns()),
        first(times[0]),
        last(times[of->rows() - 1]),
        rows(of->rows()),
        blocks(of->blocks()),
        chunk(std::move(of)) {}
  const double* times = nullptr;
  const Column* columns = nullptr;  ///< null: the staging block
  double first = 0.0, last = 0.0;   ///< times
  std::uint32_t rows = 0, blocks = 0;
  std::shared_ptr<const Chunk> chunk;
};
using Units = std::vector<ChunkView>;

}  // namespace pitchboard::telemetry::series
