// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows of a session that does not fit into memory: the coarse picture of a group once it is asked
// for, and all rows of the stretches that were looked at last. A thread of its own reads the file;
// callers never wait. Callable from any thread.

#include <atomic>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <set>

#include <telemetry/series/series_pages.h>
#include <telemetry/series/series_statistics.h>
#include <telemetry/session/session_reader.h>
#include <ui/base/workers.h>

namespace pitchboard::ui {

/// Of all rows as they are; in memory they take about as much.
double bytesOfRows(const telemetry::SessionReader& session);
/// As views of its rows shall read it: older files do not say which columns can be lost.
telemetry::GroupInfo shownGroup(const telemetry::SessionGroup& group);

class ReplayPages : public telemetry::SeriesPages {
 public:
  /// `reader`: another one of the same file, for this only. `groups`: what they are in the store
  /// that is paged, in the order of the file.
  ReplayPages(telemetry::SessionReader reader, std::size_t bytes);
  ~ReplayPages() override;

  std::shared_ptr<const telemetry::GroupSummary> summary(telemetry::GroupId group,
                                                         bool whole) override;
  std::optional<Stretch> held(telemetry::GroupId group,
                              std::optional<telemetry::TimeRange> range) override;
  void want(telemetry::TimeRange range) override;
  std::optional<telemetry::SeriesStatistics> statistics(telemetry::GroupId group,
                                                        std::uint32_t column,
                                                        telemetry::TimeRange range) override;
  bool isReading(telemetry::TimeRange range) override;
  std::uint64_t revision() override { return m_revision; }
  void setListener(std::function<void()> listener) override;
  telemetry::TimeRange range() override { return m_range; }
  std::size_t bytes() override;

  void setBytes(std::size_t bytes);

 private:
  void work();
  void readSummary(telemetry::GroupId group);
  void readRows(telemetry::TimeRange range);
  /// A store with the rows of a range; null when `goOn` ended it.
  std::shared_ptr<telemetry::SeriesStore> rowsOf(telemetry::TimeRange range,
                                                 const std::function<bool()>& goOn);
  bool isMeasuring() const;
  void measure();
  void notify();
  void forgetSummaries();
  double secondsThatFit() const;
  void keepFreeSpace();

  telemetry::SessionReader m_reader;  // of the worker
  telemetry::TimeRange m_range;
  double m_bytesPerSecond = 1.0;
  std::atomic<bool> m_ends = false;

  mutable std::mutex m_mutex;
  std::size_t m_room;
  bool m_working = false;
  std::set<telemetry::GroupId> m_askedFor;
  struct Summary {
    std::shared_ptr<const telemetry::GroupSummary> parts;
    bool whole = true;  ///< false: the first and the last part are left
  };
  std::map<telemetry::GroupId, Summary> m_summaries;
  std::list<telemetry::GroupId> m_recent;  // newest first
  struct Held {
    telemetry::TimeRange range;
    std::shared_ptr<telemetry::SeriesStore> rows;
  };
  std::list<Held> m_held;                     // the one used last is first
  std::deque<telemetry::TimeRange> m_wanted;  // the newest is last
  struct Measure {
    telemetry::GroupId group;
    std::uint32_t column;
    telemetry::TimeRange range;
    telemetry::StatisticsSum sum;
    double next;  ///< rows before it are in the sum
    bool isDone() const { return next > range.end; }
  };
  std::list<Measure> m_measures;  // the one asked for last is first
  std::atomic<std::uint64_t> m_revision = 1;
  std::mutex m_listening;
  std::function<void()> m_listener;  // of that mutex
  Workers m_worker;                  // last: it uses all of the above
};

}  // namespace pitchboard::ui
