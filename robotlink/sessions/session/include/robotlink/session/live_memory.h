// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records of a live match besides its rows: every datagram, the referee's packets decoded, and from
// time to time the whole LiveState. A recording writes them into its file; a LiveMemory keeps the
// recent ones for looking back and for saving them.

#include <deque>
#include <mutex>

#include <robotlink/live/live_watch.h>
#include <robotlink/session/live_moments.h>

namespace pitchboard::link {

/// Makes a record of everything that a watch reports. Called on the watch's thread.
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

/// The newest records that fit into a number of bytes, roughly in order of time, for looking back.
/// Any thread.
class RecordMemory : public LiveHistory {
 public:
  explicit RecordMemory(std::size_t bytes) : m_room(bytes) {}

  void remember(LiveRecord record);
  /// Records of a restored state do not belong to the past.
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

/// The memory of a live match.
class LiveMemory : public LiveRecords, public RecordMemory {
 public:
  /// `rows` receives the rows; null: rows are not kept.
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
