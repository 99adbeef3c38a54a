// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The recent past of a source in memory: the rows of every group, stored by column in chunks, with
// summaries of minimum and maximum, so that drawing a curve costs its pixels and not its samples.
// Memory has a budget; the oldest chunks are dropped first. One thread writes a group; any number
// of other threads read immutable views and never block the writer. Times are seconds of the
// source.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/series/row_sink.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

struct SeriesOptions {
  std::size_t memoryBudget = std::size_t{1} << 30;  ///< bytes for all groups together
};

struct SeriesId {
  GroupId group = 0;
  std::uint32_t column = 0;
  auto operator<=>(const SeriesId&) const = default;
};

struct Sample {
  double time = 0.0;  ///< s
  double value = 0.0;
  bool operator==(const Sample&) const = default;
};

/// The samples that one pixel column of a curve covers. Minimum and maximum ignore NaN samples, and
/// are NaN if there is no other one.
struct SeriesBucket {
  double min = 0.0, max = 0.0;
  double first = 0.0, last = 0.0;  ///< NaN if that sample is NaN
  std::uint32_t samples = 0;       ///< 0: no sample falls into this column
};

/// Statistics of the finite samples in a closed interval. Sigma is that of the population.
struct SeriesStatistics {
  std::uint64_t samples = 0;
  double mean = 0.0, min = 0.0, max = 0.0, sigma = 0.0, rms = 0.0;
  bool reading = false;  ///< covers only some rows so far; see SeriesStore::pagesRevision()
};

/// A group as it was at one instant. Immutable, for any thread; it keeps its chunks alive.
class GroupView {
 public:
  virtual ~GroupView() = default;
  virtual const GroupInfo& info() const = 0;
  /// Returns the times of the first and last row; nothing if there is no row.
  virtual std::optional<TimeRange> range() const = 0;
  virtual std::size_t rows() const = 0;
  /// Returns rows per second, over the last second of the group; 0 if unknown.
  virtual double rate() const = 0;

  virtual std::optional<Sample> latest(std::uint32_t column) const = 0;
  /// Returns the last sample at or before `time`.
  virtual std::optional<Sample> at(std::uint32_t column, double time) const = 0;
  /// Reads the whole row at or before `time`, exactly as it was appended. This includes old values
  /// of columns that were not seen (ColumnInfo::lost), which are NaN in all other calls. Returns
  /// false if there is no such row.
  virtual bool rowAt(double time, double& rowTime, std::vector<std::uint32_t>& words,
                     std::vector<double>& values) const = 0;
  /// Returns when the value last changed, or the first row's time if it never did.
  virtual std::optional<double> lastChange(std::uint32_t column) const = 0;
  /// Fills `out` with equal parts of [range.begin, range.end).
  virtual void buckets(std::uint32_t column, TimeRange range,
                       std::span<SeriesBucket> out) const = 0;
  /// Appends the samples of the closed interval in order, at most `most`. Returns whether that was
  /// all of them.
  virtual bool samples(std::uint32_t column, TimeRange range, std::vector<Sample>& out,
                       std::size_t most = SIZE_MAX) const = 0;
  virtual SeriesStatistics statistics(std::uint32_t column, TimeRange range) const = 0;
  /// Returns false if only a summary of this range is in memory: then buckets() gives an envelope,
  /// and samples() must not be connected by lines. The call starts reading the rows if they fit;
  /// SeriesStore::pagesRevision() increases when they have been read.
  virtual bool hasEveryRow(TimeRange /*range*/) const { return true; }
  /// Returns whether missing rows are being read. False also if they are too many to fit.
  virtual bool isReading(TimeRange /*range*/) const { return false; }
};

class SeriesPages;

class SeriesStore : public RowSink {
 public:
  explicit SeriesStore(SeriesOptions options = {});
  ~SeriesStore() override;
  SeriesStore(const SeriesStore&) = delete;
  SeriesStore& operator=(const SeriesStore&) = delete;

  // Writing. Any thread, but the rows of one group must come from one thread at a time. If the
  // memory budget is exceeded, the chunk whose last row is the oldest is dropped first.
  /// Registers a group, or continues a known one (isSameGroup()). Its columns may be others than
  /// before: the group keeps those that it had, and rows that do not have a column are gaps there
  /// (mergedColumns() in column_merge.h). Ids and indices of columns stay valid.
  GroupId addGroup(const GroupInfo& info) override;
  void describeGroups(std::span<const GroupInfo> groups) override;
  /// Appends a row. Rows must come in order of time. A time before the last one means that the
  /// source was put back, so rows at and after the new time are dropped first. A row of an unknown
  /// group, of another width than the last addGroup() said, or with a time that is not finite is
  /// ignored.
  void append(GroupId group, const RowView& row) override;
  /// Sets who is told of new rows. `listener` is called on the writing thread with the first row
  /// after this call, and then with the first after each call of heard(); it must return at once.
  /// Set it before rows are appended.
  void setListener(std::function<void()> listener);
  /// Requests the next call of the listener. Any thread.
  void heard() const;
  /// Drops all rows; the groups stay.
  void clear();
  /// Drops all rows later than this, because their source continues from there.
  void rewind(double time);

  // Reading. Any thread.
  /// Returns a read-only store with the rows so far. The rows are shared, so this is cheap, and
  /// they stay if this store drops them.
  std::shared_ptr<const SeriesStore> branch() const;
  /// Increases when groups were added; lists of groups then have to be read again.
  std::uint64_t groupsRevision() const;
  std::size_t groups() const;
  /// Returns a view of a group; null for an unknown id.
  std::shared_ptr<const GroupView> view(GroupId group) const;
  /// Returns the groups that a typed name means (robot_names.h); fails with the names there are.
  Result<std::vector<GroupId>> groupsNamed(std::string_view name) const;
  /// Returns the first of them; nothing if there is none.
  std::optional<GroupId> findGroup(std::string_view name) const;
  /// Returns the present name of each group, by id, all from the same instant.
  std::vector<std::string> groupNames() const;
  std::optional<SeriesId> find(std::string_view group, std::string_view column) const;
  /// Returns the times of the oldest and the newest row of all groups.
  std::optional<TimeRange> range() const;
  /// Returns the memory of all rows, without dropped chunks that a view still keeps alive.
  std::size_t memoryBytes() const;
  void setMemoryBudget(std::size_t bytes);
  /// Makes all views read rows from `pages` (<telemetry/series/series_pages.h>) instead of this
  /// store. The groups must have been added before, and no row may be appended.
  void setPages(std::shared_ptr<SeriesPages> pages);
  /// Increases when paged rows have been read, so that views know more. 0 without pages.
  std::uint64_t pagesRevision() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
