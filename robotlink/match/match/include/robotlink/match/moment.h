// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recorded moment of a simulated match: the exact state of the world, the robots' blackboards
// and, if known, what their processes remembered. Plain values; any thread.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <base/ids.h>
#include <robotlink/blackboard/blackboard.h>
#include <robotlink/match/robots_memory.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// A word of a blackboard, as bits.
struct BoardWord {
  int index = 0;
  std::uint32_t bits = 0;
  bool operator==(const BoardWord&) const = default;
};

struct MomentRobot {
  RobotId id;
  std::string behaviour;
  std::vector<BoardWord> words;  ///< known words; the others stay unchanged
  void writeTo(Blackboard& board) const;
};

struct Moment {
  sim::WorldState state;
  std::vector<MomentRobot> robots;
  /// Null if nothing is known of the processes except their blackboards.
  std::shared_ptr<const MomentPast> past;
  /// Returns what is known of this robot; null if nothing is.
  const MomentRobot* robot(RobotId id) const;
};

}  // namespace pitchboard::link
