// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks how a match is played, and what its referee punishes: who is near the ball, removals,
// robots that get stuck, states. What a report counts, too, is counted by a MatchTally. Of both
// teams, except where a name says otherwise. In play means PLAYING with a ball that anybody may
// play, outside a shoot-out; without a referee all of the time. The thread of its match; metres,
// seconds.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <simcore/world/event.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::link {

class MatchWatch {
 public:
  /// After every tick.
  void ticked(const sim::WorldState& world, std::span<const sim::Event> events);
  /// Ten times a second, of the same moment.
  void sample(const sim::WorldState& world, const sim::Snapshot& now);

  /// Share of the time in play with a standing robot within 0.5 m of the ball.
  double ballAttended() const { return shareOf(m_attended); }
  /// Share of the time in play in which two robots of a team stood within 0.5 m of each other that
  /// are neither its goalkeeper nor the nearest to the ball; of the team where it was more.
  double supportersClose() const { return shareOf(std::max(m_close[0], m_close[1])); }
  int removalsFor(PenaltyKind cause) const { return m_removals[static_cast<std::size_t>(cause)]; }
  double removalsOfTeamAndHalf() const;
  /// For the same cause within 30 s of coming back.
  int removedAgain() const { return m_removedAgain; }
  /// The longest time in play that a robot meant to walk and stayed within 0.1 m, s.
  double maxStuck() const { return m_maxStuck; }
  /// Changes of the game's state that the leagues' rules do not know.
  int illegalTransitions() const { return m_illegalTransitions; }
  /// Mean duration of READY, s.
  double ready() const;

 private:
  struct Still {
    Point place;
    double since = 0.0;
    int samples = 0, walking = 0;
  };
  double shareOf(long long samples) const {
    return m_inPlay > 0 ? static_cast<double>(samples) / static_cast<double>(m_inPlay)
                        : std::numeric_limits<double>::quiet_NaN();
  }
  void followStates(const Game& game, std::span<const sim::Event> events);
  void followRemovals(const sim::WorldState& world, std::span<const sim::Event> events);
  void countClose(const sim::WorldState& world, const sim::Snapshot& now);
  void watchStuck(const sim::WorldState& world, const sim::Snapshot& now);

  long long m_inPlay = 0, m_attended = 0;  // samples
  std::array<long long, 2> m_close{};
  std::array<int, static_cast<std::size_t>(PenaltyKind::Manual) + 1> m_removals{};
  int m_removedAgain = 0, m_halves = 1;
  std::map<int, PenaltyKind> m_penalty;                             // of a robot
  std::map<std::pair<int, PenaltyKind>, std::uint64_t> m_cameBack;  // at which tick
  std::vector<Still> m_still;                                       // of each robot
  double m_maxStuck = 0.0;
  std::uint64_t m_readyTicks = 0;
  int m_readies = 0;
  bool m_ready = false;
  std::optional<PlayState> m_state;
  int m_illegalTransitions = 0;
  double m_tickRate = 60.0;
};

}  // namespace pitchboard::link
