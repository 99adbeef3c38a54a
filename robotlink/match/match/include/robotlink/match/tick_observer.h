// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The interface of objects that see every tick of a match: the sampler of rows, the recorder of
// sessions, the archive of states. Called on the thread that plays the match. It must not block,
// and allocations slow the match down. Shared by the player (MatchPlayer, MatchRunner) and its
// creator.

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
  /// Called at the first moment, after every tick, and after a command changed a paused match.
  /// `tickTime` is the duration of the tick; 0 if there was no tick.
  virtual void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) = 0;
  /// Called before ticked() of the tick in which the events happened, and between ticks.
  virtual void happened(std::span<const MatchEvent> /*events*/) {}
  /// Called after commands changed the world, not only blackboards, between two ticks: the next
  /// tick continues from this state instead of the one that ticked() has shown. In a paused match,
  /// ticked() follows.
  virtual void worldChanged(const SimulatedMatch& /*match*/) {}
  /// Like happened(), for drawings of programs on the field.
  virtual void drew(std::span<const ReceivedDrawing> /*drawings*/) {}
  virtual void logged(const LogLine& /*line*/) {}
  /// Called when the observer was removed; no other call follows.
  virtual void left() {}
};

}  // namespace pitchboard::link
