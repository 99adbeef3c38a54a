// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Access to rows of a file that is larger than memory: a summary of all rows, and every row of the
// time ranges that are being looked at. The owner of the file implements it, and the views of a
// SeriesStore call it. Any thread. Times are seconds of the source.

#include <functional>
#include <memory>

#include <telemetry/series/series_store.h>
#include <telemetry/series/series_summary.h>

namespace pitchboard::telemetry {

class SeriesPages {
 public:
  virtual ~SeriesPages() = default;
  /// Returns the summary of a group, or null while it is being read; the call starts reading it. If
  /// not `whole`, its first and last part suffice, for lists that ask for every group.
  virtual std::shared_ptr<const GroupSummary> summary(GroupId group, bool whole) = 0;
  /// All rows of a time range.
  struct Stretch {
    TimeRange range;
    std::shared_ptr<const GroupView> rows;
  };
  /// Returns a stretch in memory that contains the range; without a range, the one used last.
  virtual std::optional<Stretch> held(GroupId group, std::optional<TimeRange> range) = 0;
  /// Starts reading all rows of the range, unless they do not fit into memory.
  virtual void want(TimeRange range) = 0;
  /// Returns statistics over all rows of the range, however many there are, or nothing while they
  /// are being read; the call starts reading them.
  virtual std::optional<SeriesStatistics> statistics(GroupId group, std::uint32_t column,
                                                     TimeRange range) = 0;
  /// Returns whether want() is still reading this range.
  virtual bool isReading(TimeRange range) = 0;
  /// Increases whenever something that was asked for has been read; then ask again.
  virtual std::uint64_t revision() = 0;
  /// Sets the function that is called when revision() has increased, on the thread that reads; null
  /// for none. The previous one is no longer called after this returns.
  virtual void setListener(std::function<void()> listener) = 0;
  /// Returns the range of all rows of the file.
  virtual TimeRange range() = 0;
  /// Returns how much memory is in use.
  virtual std::size_t bytes() = 0;
};

/// Returns a view of a group whose rows are paged. Where only the summary is in memory
/// (GroupView::hasEveryRow() is false), buckets and extremes are those of 256 rows, and samples are
/// every 256th row. `empty` is the view of the store, which knows the columns.
std::shared_ptr<const GroupView> pagedView(std::shared_ptr<const GroupView> empty, GroupId group,
                                           std::shared_ptr<SeriesPages> pages);

}  // namespace pitchboard::telemetry
