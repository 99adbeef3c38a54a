// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a match has met a stop condition of its scenario. A plain value; any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <robotlink/scenario/scenario.h>
#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

class MatchEnd {
 public:
  /// Call it with the events of each step.
  void look(std::span<const sim::Event> events);
  /// Another moment was restored: nothing has happened since.
  void forget() { *this = {}; }
  /// Returns "goal", "ball_out", "duration" or "full_time"; empty while none is met.
  std::string_view reason(const StopConditions& stop, const sim::WorldState& state) const;

 private:
  std::optional<std::uint32_t> m_goalCause;  // of the goal that was scored; sim::Event::cause
  bool m_outSeen = false;
};

}  // namespace pitchboard::link
