// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/announced_set_play.h>
#include <robotlink/cognition/referee_orders.h>

namespace pitchboard::link {
namespace {

// RefereeState::state
enum State { Initial = 0, Ready = 1, Set = 2, Playing = 3 };
// Of secState (Humanoid League) and gamePhase (others).
constexpr int shootOut = 1, timeout = 3;

bool isIn(const telemetry::RefereeState& state, int phase) {
  return state.secState == phase || state.gamePhase == phase;
}

}  // namespace

/// Restarts: who has the ball plays. The others walk to their places until a set play is taken, and
/// stand until the ball is free.
int RefereeOrders::codeInPlay(const telemetry::RefereeState& state, int team) {
  constexpr int firstSetPlay = 4, lastSetPlay = 9;  // of secState
  constexpr int size2021 = 688;
  const int secondary = state.secState.value_or(0);
  if (secondary >= firstSetPlay && secondary <= lastSetPlay && state.secStateInfo) {
    const auto& step = *state.secStateInfo;
    m_ballTeam = step[0];
    const bool frozen = state.size == size2021 ? step[1] == 0 : step[1] == 1;
    if (frozen) return refereeStop;
    return m_ballTeam == team ? refereePlay : refereeReady;
  }
  if (state.league == telemetry::League::HumanoidSoccer && state.setPlay.value_or(0) != 0) {
    return state.kickOffTeam == team ? refereePlay : refereeReady;
  }
  if (state.secondaryTime.value_or(0) <= 0) m_ballTeam.reset();  // the ball is free
  const bool exclusive = state.league != telemetry::League::StandardPlatform &&
                         state.secondaryTime.value_or(0) > 0 && !isIn(state, shootOut);
  const std::optional<int> ballTeam = m_ballTeam ? m_ballTeam : state.kickOffTeam;
  return exclusive && ballTeam && ballTeam != team ? refereeSet : refereePlay;
}

std::optional<RefereeOrder> RefereeOrders::take(const telemetry::RefereeState& state, int team,
                                                int player) {
  if (state.trueData()) return std::nullopt;
  const telemetry::RefereeTeam* own = state.team(team);
  if (own == nullptr) return std::nullopt;
  const AnnouncedSetPlay announced = setPlayIn(state);
  RefereeOrder order{refereeStop, announced.kind, announced.team == team, own->score};
  for (const telemetry::RefereeTeam& one : state.teams) {
    if (one.number != team) order.goalsTheirs = one.score;
  }
  order.secondsLeft = state.secsRemaining;
  if (state.state == Playing) {
    order.code = codeInPlay(state, team);
  } else {
    m_ballTeam.reset();
    if (state.state == Ready) order.code = refereeReady;
    if (state.state == Set) order.code = refereeSet;
  }
  const auto players = own->players();
  const bool penalised = player >= 1 && static_cast<std::size_t>(player) <= players.size() &&
                         players[static_cast<std::size_t>(player) - 1].penalty != 0;
  const bool stands = penalised || isIn(state, timeout) || state.stopped.value_or(0) != 0;
  if (stands) order.code = refereeStop;
  return order;
}

RefereeVariables::RefereeVariables(const VariableCatalog& map)
    : m_code(map.intVar("COM_REFEREE").value_or(IntVar{-1})),
      m_setPlay(map.intVar("COM_SET_PLAY").value_or(IntVar{-1})),
      m_setPlayIsOurs(map.intVar("COM_SET_PLAY_OURS").value_or(IntVar{-1})),
      m_goalsOwn(map.intVar("COM_GOALS_OWN").value_or(IntVar{-1})),
      m_goalsTheirs(map.intVar("COM_GOALS_THEIRS").value_or(IntVar{-1})),
      m_secondsLeft(map.intVar("COM_SECONDS_LEFT").value_or(IntVar{-1})) {}

void RefereeVariables::write(Blackboard& board, const RefereeOrder& order, bool extended) const {
  writeIfPresent(board, m_code, order.code);
  if (!extended) return;
  writeIfPresent(board, m_setPlay, static_cast<int>(order.setPlay));
  writeIfPresent(board, m_setPlayIsOurs, order.setPlayIsOurs ? 1 : 0);
  writeIfPresent(board, m_goalsOwn, order.goalsOwn);
  writeIfPresent(board, m_goalsTheirs, order.goalsTheirs);
  writeIfPresent(board, m_secondsLeft, order.secondsLeft);
}

}  // namespace pitchboard::link
