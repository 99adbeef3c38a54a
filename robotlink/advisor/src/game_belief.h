// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot's situation as rollouts want it: who plays, and what is believed of everybody. Turned so
// that the robot's team is the one that attacks right. Metres, radians, seconds; one thread.

#include <vector>

#include <robotlink/cognition/situation.h>
#include <robotlink/rollout/belief.h>

#include "opponent_model.h"

namespace pitchboard::link {

/// The places of players in setupFor() and beliefOf().
inline constexpr std::size_t ownPlayer = 0, mateKeeper = 1, firstMate = 2, theirKeeper = 5,
                             firstTheirs = 6, allPlayers = 11;

/// Everybody plays with the parameters of this robot, opponents without its peculiarities
/// (aim_side, keeper_aside). Opponents may be any of the models of OpponentModel if the advisor
/// learns.
rollout::Setup setupFor(const ProcessOptions& options);

/// Opponents that were seen within the last seconds, also those that decision has forgotten.
class OpponentMemory {
 public:
  struct Known {
    Point place;
    double seen = 0.0;  ///< when
  };
  void update(const Points& opponents, double now);
  const std::vector<Known>& known() const { return m_known; }

 private:
  std::vector<Known> m_known;
};

/// `learned`: of the opponents.
rollout::Belief beliefOf(const Situation& now, const OpponentMemory& opponents, double time,
                         const ProcessOptions& options, const OpponentModel& learned = {});

}  // namespace pitchboard::link
