// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a recorded robot sensed, bit for bit, also between two rows and where a process has cleared
// it: the pieces of the match in the session are played again with the recorded commands. Only
// sessions of simulated matches have them. Private to the module; one thread at a time.

#include <deque>
#include <optional>
#include <vector>

#include <robotlink/session/state_segment.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

class RecordedWorld {
 public:
  /// Adds a piece, in the order of the session.
  void add(StateSegment segment) { m_waiting.push_back(std::move(segment)); }
  /// Goes on to this tick. Returns false if no piece leads there: then nothing is known of it.
  bool goTo(std::uint64_t tick);
  /// Returns the state after that tick; null if it is not known.
  const sim::WorldState* state() const { return m_isKnown ? &m_simulation->state() : nullptr; }
  /// Returns what the robot sensed in that tick; null if it is not known.
  const sim::Percepts* percepts(RobotId robot) const;

 private:
  bool begin(std::uint64_t tick);

  std::deque<StateSegment> m_waiting;
  std::optional<sim::Simulation> m_simulation;
  std::vector<std::vector<sim::RobotCommand>> m_commands;  // of the piece that is played
  std::size_t m_next = 0;                                  // of them
  std::vector<sim::Percepts> m_percepts;
  bool m_isKnown = false;
  bool m_hasStepped = false;  // m_percepts are of the state's tick
};

}  // namespace pitchboard::link
