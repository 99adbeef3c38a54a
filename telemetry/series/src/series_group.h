// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The writing side of one group. Rows go to the staging block under a lock of the group, which only
// who clears or replaces the group could hold otherwise; every 64 rows the block becomes columns
// and a new state is published under a lock that is held for a pointer's exchange. Private to the
// library.

#include <memory>
#include <mutex>

#include <telemetry/series/column_merge.h>

#include "series_view.h"

namespace pitchboard::telemetry::series {

class Group {
 public:
  explicit Group(std::shared_ptr<const Layout> layout);

  /// A copy for reading: it shares the rows so far, and put() refuses. Any thread.
  std::unique_ptr<Group> branch() const;

  // The group's writer thread.
  enum class Put { Done, BlockFull, GoesBack, Refused };
  /// BlockFull: the row is in, closeBlock() is due. GoesBack: truncate() first, then again.
  Put put(const RowView& row);

  // Under the store's structure lock.
  void closeBlock();
  void truncate(double time);
  void clear();
  /// Rows come with these columns from now on, and the group has them beside those that it had.
  /// False: it is as before.
  bool setInfo(const GroupInfo& info);
  /// Another name and other facts; rows come with the same columns as before.
  void describe(const GroupInfo& now);
  /// Time of the last row of the oldest chunk; nothing when only the staging block is left.
  std::optional<double> endOfOldest() const;
  /// Lets the oldest chunk go.
  void dropOldest();
  std::size_t bytes() const { return m_bytes; }

  // Any thread.
  std::shared_ptr<const View> view() const;

 private:
  explicit Group(std::shared_ptr<const State> state);
  void addBlock();
  void empty();
  void publish();
  void countBytes();
  void newStaging();
  void setInputSize(const std::vector<ColumnInfo>& columns);
  void convertTo(const std::shared_ptr<const Layout>& layout);

  std::mutex m_write;                  // of m_staging, m_lastTime, m_any; after the structure lock
  std::shared_ptr<Staging> m_staging;  // null: for reading
  State m_next;  // what is published next; layout and staging under m_write too
  std::size_t m_bytes = 0;
  double m_lastTime = 0.0;
  bool m_any = false;
  // Of the rows that come, under m_write too: they may have fewer columns than the group, in
  // another order.
  RowMap m_input;
  std::unique_ptr<const GroupInfo> m_given;  // as it was set, if it is not that of the group
  std::size_t m_inputWords = 0, m_inputValues = 0;
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_values;

  mutable std::mutex m_mutex;  // of m_state only
  std::shared_ptr<const State> m_state;
};

}  // namespace pitchboard::telemetry::series
