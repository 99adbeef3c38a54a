// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The drawings of a simulated match at any past moment, rebuilt from the datagrams. A DrawingMemory
// keeps those of a running match, a session file those of a recorded one. (LiveMoments does the
// same for live matches.) Times are seconds of the match.

#include <robotlink/match/tick_observer.h>
#include <robotlink/session/live_memory.h>

namespace pitchboard::link {

/// Rebuilds moments of one history; fast if they follow each other. One thread at a time.
class DrawingMoments {
 public:
  std::vector<telemetry::RobotDrawings> at(const LiveHistory& history, double time);

 private:
  telemetry::DrawingStore m_store;
  double m_time = 0.0;  // of m_store
  bool m_begun = false;
};

/// Returns a datagram with a drawing in the form of a session.
LiveRecord drawingRecord(const ReceivedDrawing& drawing);

/// Keeps the drawings of a match, which it observes.
class DrawingMemory : public TickObserver, public RecordMemory {
 public:
  explicit DrawingMemory(std::size_t bytes = std::size_t{64} << 20) : RecordMemory(bytes) {}

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void drew(std::span<const ReceivedDrawing> drawings) override;
};

}  // namespace pitchboard::link
