// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One of the worlds that are stepped together: a match, and whether its scenario is over. Made
// again for a new beginning, unless nothing in it remembers anything but its moment. For one thread
// at a time; owned by Worlds.

#include <cstdint>
#include <string_view>
#include <vector>

#include <robotlink/capi/worlds.h>

namespace pitchboard::link {

class World {
 public:
  static Result<World> create(const Scenario& scenario, const MatchOptions& options,
                              std::uint64_t seed);

  SimulatedMatch& match() { return m_match; }
  const SimulatedMatch& match() const { return m_match; }
  /// Empty while it goes on.
  std::string_view finishedBy() const { return m_finishedBy; }
  /// Place of the reason in columns::finishReasons, from 1; 0: it goes on.
  int finishedNumber() const;
  /// It has been stepped since its beginning or a snapshot.
  bool sensed() const { return m_sensed; }
  Blackboard& board(std::size_t robot) { return *m_boards[robot]; }
  const Blackboard& board(std::size_t robot) const { return *m_boards[robot]; }

  /// Up to so many ticks.
  void play(int ticks);
  /// Asks for its memory ahead of its turn: where it is, and once that is there, what it plays
  /// with. Of many worlds each has left the processor's caches since its last tick. fetchSelf()
  /// returns how many cache lines it asked for.
  std::size_t fetchSelf() const;
  void fetchParts() const;
  WorldSnapshot snapshot() const;
  Result<void> restore(const WorldSnapshot& snapshot);
  /// This beginning, with another seed; false when it cannot.
  bool beginAgain(const Moment& beginning, std::uint64_t seed);
  /// It was begun so before, and nothing has changed since.
  bool beginsQuickly() const { return m_beginsQuickly; }
  void mustBeMadeAnew() { m_beginsQuickly = false; }

 private:
  explicit World(SimulatedMatch match);
  void findBoards();
  void forgetEvents();

  SimulatedMatch m_match;
  std::vector<Blackboard*> m_boards;
  std::string_view m_finishedBy;
  bool m_sensed = false;
  bool m_beginsQuickly = false;
  int m_sinceForgot = 0;           // ticks
  std::vector<MatchEvent> m_news;  // scratch
};

}  // namespace pitchboard::link
