// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/referee_word.h>

namespace pitchboard::link {
namespace {

// RefereeState::state
enum State { Initial = 0, Ready = 1, Set = 2, Playing = 3 };
constexpr int timeout = 3;  // of secState (Humanoid League) and gamePhase (others)

}  // namespace

std::optional<int> refereeWord(const telemetry::RefereeState& state, int team, int player) {
  if (state.trueData()) return std::nullopt;
  const telemetry::RefereeTeam* own = state.team(team);
  if (own == nullptr) return std::nullopt;
  const auto players = own->players();
  if (player >= 1 && static_cast<std::size_t>(player) <= players.size() &&
      players[static_cast<std::size_t>(player) - 1].penalty != 0) {
    return refereeStop;
  }
  if (state.secState == timeout || state.gamePhase == timeout) return refereeStop;
  if (state.stopped.value_or(0) != 0) return refereeStop;
  switch (state.state) {
    case Ready:
      return refereeReady;
    case Set:
      return refereeSet;
    case Playing:
      return refereePlay;
    default:
      return refereeStop;
  }
}

}  // namespace pitchboard::link
