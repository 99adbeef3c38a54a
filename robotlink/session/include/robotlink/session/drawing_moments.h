// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What robots of a simulated match have drawn, at any moment of the past: made again from their
// datagrams, which a DrawingMemory keeps of a match that is played, and a session file of one that
// was recorded. (Of a live match LiveMoments does the same.) Times are seconds of the match.

#include <deque>
#include <mutex>

#include <robotlink/match/tick_observer.h>
#include <robotlink/session/live_moments.h>

namespace pitchboard::link {

/// Goes through one history; fast when moments follow each other. One thread.
class DrawingMoments {
 public:
  std::vector<telemetry::RobotDrawings> at(const LiveHistory& history, double time);

 private:
  telemetry::DrawingBook m_book;
  double m_time = 0.0;  // of the book
  bool m_begun = false;
};

/// A datagram that was drawn, as a session keeps it.
LiveRecord drawingRecord(const HeardDrawing& drawing);

/// The newest drawings of a match that fit into `bytes`. Observes it; asked from any thread.
class DrawingMemory : public TickObserver, public LiveHistory {
 public:
  static constexpr std::size_t usualBytes = std::size_t{64} << 20;
  explicit DrawingMemory(std::size_t bytes = usualBytes) : m_room(bytes) {}

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void drew(std::span<const HeardDrawing> drawings) override;

  void walk(std::span<const telemetry::SessionStream> streams, telemetry::TimeRange range,
            const std::function<bool(const LiveRecord&)>& visit) const override;
  double begin() const override;

 private:
  const std::size_t m_room;
  mutable std::mutex m_mutex;
  std::deque<std::shared_ptr<const LiveRecord>> m_records;  // in order of time
  std::size_t m_bytes = 0;
};

}  // namespace pitchboard::link
