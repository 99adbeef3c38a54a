// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/referee_orders.h>

namespace pitchboard::link {
namespace {

/// The number of the team with this index, or noTeam.
int numberOf(const Game& game, int index) {
  return index < 0 ? Game::noTeam : game.teams[static_cast<std::size_t>(index)].number;
}

IntVar wordIn(const VariableCatalog& map, std::string_view name) {
  return map.intVar(name).value_or(IntVar{-1});
}

}  // namespace

/// Restarts: who has the ball plays. The others walk to their places until a set play is taken, and
/// stand until the ball is free. The Standard Platform League has no such orders.
int RefereeOrders::codeInPlay(const Game& game, int team) {
  if (game.league == League::StandardPlatform) return refereePlay;
  if (game.setPlay() != SetPlay::None) {
    const int taker = numberOf(game, game.setPlayTeam());
    if (game.league == League::Humanoid) m_ballTeam = taker;
    if (game.restart.step == Restart::Step::Placing) return refereeStop;
    return taker == team ? refereePlay : refereeReady;
  }
  if (game.countdown.ticks <= 0) m_ballTeam.reset();  // the ball is free
  const bool exclusive = game.countdown.ticks > 0 && game.phase != GamePhase::ShootOut;
  const int ballTeam = m_ballTeam.value_or(numberOf(game, game.kickOff));
  return exclusive && ballTeam != Game::noTeam && ballTeam != team ? refereeSet : refereePlay;
}

std::optional<int> RefereeOrders::take(const Game& game, int team, int player) {
  const int index = game.teamNumbered(team);
  if (index == Game::noTeam) return std::nullopt;
  int code = refereeStop;
  if (game.state == PlayState::Playing) {
    code = codeInPlay(game, team);
  } else {
    m_ballTeam.reset();
    if (game.state == PlayState::Ready) code = refereeReady;
    if (game.state == PlayState::Set) code = refereeSet;
  }
  const auto& players = game.teams[static_cast<std::size_t>(index)].players;
  const bool penalised = player >= 1 && static_cast<std::size_t>(player) <= players.size() &&
                         players[static_cast<std::size_t>(player) - 1].penalty != PenaltyKind::None;
  const bool stands = penalised || game.phase == GamePhase::Timeout || game.stopped;
  return stands ? refereeStop : code;
}

RefereeVariables::RefereeVariables(const VariableCatalog& map)
    : m_code(wordIn(map, names[0])),
      m_setPlay(wordIn(map, names[1])),
      m_setPlayIsOurs(wordIn(map, names[2])),
      m_goalsOwn(wordIn(map, names[3])),
      m_goalsTheirs(wordIn(map, names[4])),
      m_secondsLeft(wordIn(map, names[5])) {}

void RefereeVariables::write(Blackboard& board, int code, const Game& game, int team,
                             bool extended) const {
  writeIfPresent(board, m_code, code);
  if (!extended) return;
  const bool isFirst = game.teams[0].number == team;
  writeIfPresent(board, m_setPlay, static_cast<int>(simulated(game.setPlay())));
  writeIfPresent(board, m_setPlayIsOurs,
                 numberOf(game, game.setPlayTeam()) == team && game.setPlay() != SetPlay::None);
  writeIfPresent(board, m_goalsOwn, game.teams[isFirst ? 0 : 1].score);
  writeIfPresent(board, m_goalsTheirs, game.teams[isFirst ? 1 : 0].score);
  writeIfPresent(board, m_secondsLeft, game.secondsLeft());
}

}  // namespace pitchboard::link
