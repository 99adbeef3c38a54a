// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What happened in a step of the simulation. Plain values.

#include <cstdint>

#include <base/ids.h>

namespace pitchboard::sim {

enum class EventKind : std::uint8_t { Goal, BallOut, Kick, Fall, GotUp, UnknownAction };

/// Something that happened in the last step. `robot` is 0 when no robot is concerned; a goal has
/// the side that scored in `value` (0 left, 1 right), a kick and an unknown action their code.
struct Event {
  EventKind kind = EventKind::Goal;
  std::uint64_t tick = 0;
  RobotId robot;
  int value = 0;
  bool operator==(const Event&) const = default;
};

}  // namespace pitchboard::sim
