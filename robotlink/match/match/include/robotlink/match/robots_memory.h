// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The memory of the reference processes inside a match after one tick (particles, plans, messages
// of team-mates) with their blackboards, and how the match continued from there. The processes of a
// later moment are restored by playing them through that stretch. Immutable values; any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <base/ids.h>
#include <base/team_color.h>
#include <robotlink/blackboard/blackboard.h>
#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/cognition/team_channel.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// When robots receive the next packet of the referee.
struct RefereeRhythm {
  std::uint64_t lastTick = 0;
  bool stopped = false;
  int quick = 0;  ///< remaining packets that are sent in quick succession
};

struct RobotsMemory {
  struct Process {
    std::string name;                                ///< in its robot's profile
    std::unique_ptr<const CognitiveProcess> memory;  ///< null: it remembers nothing
  };
  struct Robot {
    RobotId id;
    std::string behaviour;
    std::array<std::uint32_t, Blackboard::words> board{};
    RefereeOrders orders;
    std::vector<Process> processes;
  };
  std::uint64_t tick = 0;
  std::vector<Robot> robots;
  std::array<InProcessTeamChannel, teamColors.size()> channels;
  RefereeRhythm referee;
  std::size_t bytes = 0;  ///< approximate size of all of this
};

/// A stretch of a match as it was played: the state at its beginning, and the robots' commands of
/// each tick.
struct PlayedStretch {
  sim::WorldState from;
  std::vector<std::vector<sim::RobotCommand>> commands;
};

/// The past of a moment. The first stretch begins where the memory was saved, each later one at the
/// end of the one before, and the last one ends at the moment.
struct MomentPast {
  std::shared_ptr<const RobotsMemory> memory;
  std::vector<PlayedStretch> played;
};

}  // namespace pitchboard::link
