// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows that are not all in memory: a coarse picture of everything, and the rows of the stretches
// that are being looked at. The owner of the file implements it; views of a SeriesStore ask it.
// Callable from any thread.

#include <functional>
#include <memory>

#include <telemetry/series/series_store.h>
#include <telemetry/series/series_summary.h>

namespace pitchboard::telemetry {

class SeriesPages {
 public:
  virtual ~SeriesPages() = default;
  /// Null while it is being read; asking for it has it read. Not `whole`: its first and last part
  /// will do, for lists that ask for every group.
  virtual std::shared_ptr<const GroupSummary> summary(GroupId group, bool whole) = 0;
  /// Every row of one stretch.
  struct Stretch {
    TimeRange range;
    std::shared_ptr<const GroupView> rows;
  };
  /// A stretch in memory that contains this range; without a range the one that was used last.
  virtual std::optional<Stretch> held(GroupId group, std::optional<TimeRange> range) = 0;
  /// Reads the rows of this range, unless so long a stretch does not fit into memory.
  virtual void want(TimeRange range) = 0;
  /// Of every row of the range, however many there are; nothing while they are being read. Asking
  /// has them read.
  virtual std::optional<SeriesStatistics> statistics(GroupId group, std::uint32_t column,
                                                     TimeRange range) = 0;
  /// want() is not done yet with this range.
  virtual bool isReading(TimeRange range) = 0;
  /// Grows whenever something that was asked for has been read: ask again.
  virtual std::uint64_t revision() = 0;
  /// Called whenever revision() has grown, from the thread that reads; null: nobody wants to know.
  /// The former one is not called any more once this has returned.
  virtual void setListener(std::function<void()> listener) = 0;
  /// Of everything there is.
  virtual TimeRange range() = 0;
  virtual std::size_t bytes() = 0;
};

/// A view of a group whose rows are paged. Where only the coarse picture is in memory
/// (GroupView::hasEveryRow() is false), buckets and extremes are those of 256 rows, and samples are
/// every 256th row.
std::shared_ptr<const GroupView> pagedView(std::shared_ptr<const GroupView> empty, GroupId group,
                                           std::shared_ptr<SeriesPages> pages);

}  // namespace pitchboard::telemetry
