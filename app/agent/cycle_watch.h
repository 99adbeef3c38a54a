// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Notices at once that a program announces the beginning or the end of a cycle (docs/agent.md): the
// kernel wakes the agent if the program asks it to, so that waiting costs nothing. Announcements
// without that are noticed at the next reading. One thread at a time.

#include <cstdint>
#include <span>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>

#include "schedule.h"

namespace pitchboard::agent {

class CycleWatch {
 public:
  /// After an announcement nothing is read earlier than this, however many there are.
  static constexpr Time minStep = std::chrono::milliseconds(1);

  /// Watches the variables among `all` that announce cycles, on the blackboard of this key.
  CycleWatch(std::span<const link::Variable> all, int key);
  CycleWatch(const CycleWatch&) = delete;
  CycleWatch& operator=(const CycleWatch&) = delete;
  ~CycleWatch();

  /// Attaches to the blackboard that there is now.
  void attach();
  /// Takes a reading of all variables; empty: there is no blackboard.
  void take(const std::vector<std::uint32_t>& words);
  /// Returns at `tick`, when a word is no longer as it was read, or after a signal.
  void await(Time now, Time tick);

 private:
  void detach();
  void awaitChange(Time now, Time tick) const;

  int m_key;
  std::vector<std::size_t> m_places, m_words;  // of the variables: in all, on the blackboard
  std::vector<std::uint32_t> m_known;
  const std::uint32_t* m_board = nullptr;
};

}  // namespace pitchboard::agent
