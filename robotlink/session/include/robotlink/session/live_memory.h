// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is kept of a live match besides rows: every datagram as it came, the referee's packets
// decoded, and now and then all that is known. A recording writes it into its file; a LiveMemory
// holds what has just happened, for looking back and for saving it.

#include <deque>
#include <mutex>

#include <robotlink/live/live_watch.h>
#include <robotlink/session/live_moments.h>

namespace pitchboard::link {

/// Makes records of what a watch tells, in its thread.
class LiveRecords : public LiveObserver {
 public:
  void received(const LiveDatagram& datagram) override;
  void frameMade(const MatchFrame& frame) override;
  void remembered(double time, std::string_view state) override;

 protected:
  virtual void keep(LiveRecord record) = 0;

 private:
  std::optional<telemetry::RefereeState> m_refereeNews;  // not in a frame yet
};

/// The newest records that fit into so many bytes, about in order of time: what is looked back to.
/// Any thread.
class RecordMemory : public LiveHistory {
 public:
  explicit RecordMemory(std::size_t bytes) : m_room(bytes) {}

  void remember(LiveRecord record);
  /// What was put back is not the past.
  void forgetAfter(double time);

  void walk(std::span<const telemetry::SessionStream> streams, telemetry::TimeRange range,
            const std::function<bool(const LiveRecord&)>& visit) const override;
  double begin() const override;

 private:
  using Kept = std::shared_ptr<const LiveRecord>;
  const std::size_t m_room;
  mutable std::mutex m_mutex;
  std::deque<Kept> m_records;
  std::size_t m_bytes = 0;
};

/// Of a live match.
class LiveMemory : public LiveRecords, public RecordMemory {
 public:
  /// `rows`: where the rows go; null: nowhere.
  explicit LiveMemory(std::shared_ptr<telemetry::RowSink> rows = nullptr,
                      std::size_t bytes = std::size_t{128} << 20)
      : RecordMemory(bytes), m_rows(std::move(rows)) {}

  std::shared_ptr<telemetry::RowSink> rows() override { return m_rows; }

 protected:
  void keep(LiveRecord record) override { remember(std::move(record)); }

 private:
  const std::shared_ptr<telemetry::RowSink> m_rows;
};

}  // namespace pitchboard::link
