// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/referee_word.h>

namespace pitchboard::link {
namespace {

// RefereeState::state
enum State { Initial = 0, Ready = 1, Set = 2, Playing = 3 };
constexpr int timeout = 3;  // of secState (Humanoid League) and gamePhase (others)

/// Restarts: who has the ball plays. The others walk to their places until a set play is taken, and
/// stand until a kick-off is.
int wordInPlay(const telemetry::RefereeState& state, int team) {
  constexpr int firstSetPlay = 4, lastSetPlay = 9;  // of secState
  constexpr int size2021 = 688;
  const int secondary = state.secState.value_or(0);
  if (secondary >= firstSetPlay && secondary <= lastSetPlay && state.secStateInfo) {
    const auto& step = *state.secStateInfo;
    const bool frozen = state.size == size2021 ? step[1] == 0 : step[1] == 1;
    if (frozen) return refereeStop;
    return step[0] == team ? refereePlay : refereeReady;
  }
  if (state.league == telemetry::League::HumanoidSoccer && state.setPlay.value_or(0) != 0) {
    return state.kickOffTeam == team ? refereePlay : refereeReady;
  }
  const bool waits = state.league != telemetry::League::StandardPlatform &&
                     state.secondaryTime.value_or(0) > 0 && state.kickOffTeam &&
                     state.kickOffTeam != team && state.gamePhase.value_or(0) == 0 &&
                     secondary == 0;
  return waits ? refereeSet : refereePlay;
}

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
      return wordInPlay(state, team);
    default:
      return refereeStop;
  }
}

}  // namespace pitchboard::link
