// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sees every tick of a match that is played: the sampler of rows, the recorder of sessions, the
// archive of states. Called on the thread that plays the match: must not wait, and what it
// allocates makes the match slower. Owned by whoever plays (MatchPlayer, MatchRunner) and its
// maker.

#include <chrono>
#include <span>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/match/match_drawings.h>
#include <robotlink/match/simulated_match.h>

namespace pitchboard::link {

class TickObserver {
 public:
  virtual ~TickObserver() = default;
  /// At the first moment, after every tick, and after a command changed a match that stands still.
  /// `tickTime`: what the tick took; zero where there was none.
  virtual void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) = 0;
  /// Before ticked() of the tick in which they happened; also between ticks.
  virtual void happened(std::span<const MatchEvent> /*events*/) {}
  /// Commands changed the world (not only blackboards) between two ticks: the next tick goes on
  /// from here and not from what ticked() has shown. Before the ticked() of a match that stands
  /// still.
  virtual void worldChanged(const SimulatedMatch& /*match*/) {}
  /// As happened(): what programs have drawn on the field.
  virtual void drew(std::span<const ReceivedDrawing> /*drawings*/) {}
  virtual void logged(const LogLine& /*line*/) {}
  /// It was taken out of the observers: nothing more is shown to it.
  virtual void left() {}
};

}  // namespace pitchboard::link
