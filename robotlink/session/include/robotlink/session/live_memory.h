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
  explicit LiveRecords(int refereePort) : m_refereePort(refereePort) {}

  void heard(const RobotKey& robot, double time, const telemetry::DatagramView& datagram,
             const telemetry::TextDecoder& decoder, const telemetry::DecodedText& decoded) override;
  void refereeHeard(double time, const telemetry::DatagramView& datagram,
                    const telemetry::RefereeState& state) override;
  void unusedHeard(double time, const telemetry::DatagramView& datagram) override;
  void frameMade(const MatchFrame& frame) override;
  void remembered(double time, std::string_view books) override;

 protected:
  virtual void keep(LiveRecord record) = 0;

 private:
  void keep(telemetry::SessionStream stream, double time, const telemetry::DatagramView& datagram);

  const int m_refereePort;
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
  explicit LiveMemory(int refereePort, std::size_t bytes = std::size_t{128} << 20)
      : LiveRecords(refereePort), RecordMemory(bytes) {}

 protected:
  void keep(LiveRecord record) override { remember(std::move(record)); }
};

}  // namespace pitchboard::link
