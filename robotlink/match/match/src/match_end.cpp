// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/match_end.h>

#include <robotlink/match/due_ticks.h>

namespace pitchboard::link {

void MatchEnd::look(std::span<const sim::Event> events) {
  for (const sim::Event& event : events) {
    if (event.kind == sim::EventKind::Undone && m_goalCause == event.cause) m_goalCause.reset();
    if (event.kind == sim::EventKind::Goal) m_goalCause = event.cause;
    m_outSeen = m_outSeen || event.kind == sim::EventKind::BallOut;
  }
}

std::string_view MatchEnd::reason(const StopConditions& stop, const sim::WorldState& state) const {
  if (stop.goal && m_goalCause) return "goal";
  if (stop.ballOut && m_outSeen) return "ball_out";
  if (stop.duration && state.tick >= firstTickAtOrAfter(*stop.duration, state.settings.tickRate)) {
    return "duration";
  }
  return state.game && state.game->over ? "full_time" : "";
}

}  // namespace pitchboard::link
