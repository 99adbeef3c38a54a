// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The writer's side of one group. Rows go to the staging block without a lock; every 64 rows the
// block becomes columns and a new state is published under a lock that is held for a pointer's
// exchange. Private to the library.

#include <mutex>

#include "series_view.h"

namespace pitchboard::telemetry::series {

class Group {
 public:
  explicit Group(std::shared_ptr<const Layout> layout);

  // Writer thread.
  bool fits(const RowView& row) const;
  bool goesBack(double time) const { return m_any && time < m_lastTime; }
  /// False when the staging block is full: closeBlock() is due.
  bool put(const RowView& row);

  // Under the store's structure lock (the writer, or who changes the budget).
  void closeBlock();
  void truncate(double time);
  void clear();
  /// The same columns with other attributes.
  void setLayout(std::shared_ptr<const Layout> layout);
  /// Time of the oldest row that can leave; nothing when only the staging block is left.
  std::optional<double> oldestTime() const;
  /// Lets the oldest chunk go.
  void dropOldest();
  std::size_t bytes() const { return m_bytes; }

  // Any thread.
  std::shared_ptr<const View> view() const;

 private:
  void addBlock();
  void publish();
  void countBytes();
  void newStaging();

  std::shared_ptr<Staging> m_staging;
  State m_next;                 // what is published next
  std::size_t m_bytes = 0;
  double m_lastTime = 0.0;
  bool m_any = false;

  mutable std::mutex m_mutex;   // of m_state only
  std::shared_ptr<const State> m_state;
};

}  // namespace pitchboard::telemetry::series
