// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What robots of a simulated match have drawn, at any moment of the past: made again from their
// datagrams, which a DrawingMemory keeps of a match that is played, and a session file of one that
// was recorded. (Of a live match LiveMoments does the same.) Times are seconds of the match.

#include <robotlink/match/tick_observer.h>
#include <robotlink/session/live_memory.h>

namespace pitchboard::link {

/// Goes through one history; fast when moments follow each other. One thread.
class DrawingMoments {
 public:
  std::vector<telemetry::RobotDrawings> at(const LiveHistory& history, double time);

 private:
  telemetry::DrawingStore m_store;
  double m_time = 0.0;  // of the book
  bool m_begun = false;
};

/// A datagram that was drawn, as a session keeps it.
LiveRecord drawingRecord(const ReceivedDrawing& drawing);

/// Of a match, which it observes.
class DrawingMemory : public TickObserver, public RecordMemory {
 public:
  explicit DrawingMemory(std::size_t bytes = std::size_t{64} << 20) : RecordMemory(bytes) {}

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void drew(std::span<const ReceivedDrawing> drawings) override;
};

}  // namespace pitchboard::link
