// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the reference processes inside a match remember after one tick (particles, plans, what team
// mates said), with their blackboards; and how the match went on from there, so that the processes
// of a later moment are made again by playing them through it. Values that nobody changes: any
// thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <base/ids.h>
#include <robotlink/blackboard/blackboard.h>
#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/cognition/team_channel.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/team_color.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// When robots hear the referee next.
struct RefereeRhythm {
  std::uint64_t lastTick = 0;
  bool stopped = false;
  int quick = 0;  ///< packets that come quickly, still
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
  std::size_t bytes = 0;  ///< roughly
};

/// A stretch of a match as it was played: from a state on, what the robots were told tick by tick.
struct PlayedStretch {
  sim::WorldState from;
  std::vector<std::vector<sim::RobotCommand>> commands;
};

/// What came before a moment. The first stretch begins where the memory was taken, each other where
/// the one before ends, and the last one ends at the moment.
struct MomentPast {
  std::shared_ptr<const RobotsMemory> memory;
  std::vector<PlayedStretch> played;
};

}  // namespace pitchboard::link
