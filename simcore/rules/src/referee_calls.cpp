// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "referee_table.h"

namespace pitchboard::sim {

void RefereeTable::carryOut(const RefereeCall& call) {
  m_cause = call.cause;
  const auto robot = static_cast<std::size_t>(
      std::ranges::find(m_world.robots, call.robot, &RobotIdentity::id) - m_world.robots.begin());
  const auto team = static_cast<std::size_t>(std::max(0, call.team));
  switch (call.kind) {
    case CallKind::State:
      carryOut(call.state);
      break;
    case CallKind::KickOff:
      m_game.kickOff = call.team;
      break;
    case CallKind::Goal:
      if (call.value < 0) {
        countGoal(team, -1);
        mirror();
        report(EventKind::ScoreCorrected, m_game.leftTeam() == team ? 0 : 1);
      } else {
        goal(team);
      }
      break;
    case CallKind::SetPlay:
      if (call.setPlay == SetPlay::None)
        inPlay();
      else
        beginSetPlay(call.setPlay, call.team, call.place.value_or(m_now.ball));
      break;
    case CallKind::NextStep:
      nextStep();
      break;
    case CallKind::DropBall:
      dropBall();
      break;
    case CallKind::Penalise:
      penalise(robot, call.penalty);
      break;
    case CallKind::Pardon:
      pardon(robot);
      break;
    case CallKind::Card: {
      GamePlayer& one = *player(robot);
      ++(call.value == 0 ? one.warnings : call.value == 1 ? one.yellow : one.red);
      if (one.warnings >= 2) one.warnings = 0, ++one.yellow;
      if (one.yellow >= 2) one.yellow = 0, ++one.red;
      if (one.red > 0) penalise(robot, PenaltyKind::SentOff);
      break;
    }
    case CallKind::NextHalf:
      m_game.over = false;
      nextHalf();
      break;
    case CallKind::ShootOut:
      m_game.over = false;
      beginPhase(GamePhase::ShootOut);
      break;
    case CallKind::Timeout:
      if (call.team >= 0) ++m_game.teams[team].timeouts;
      m_game.phaseBefore = m_game.phase;
      m_game.phase = GamePhase::Timeout;
      enter(PlayState::Initial);
      m_game.countdown = {ticks(call.team >= 0 ? m_rules.timeoutTime : m_rules.refereeTimeoutTime),
                          true};
      report(EventKind::PhaseChanged, static_cast<int>(GamePhase::Timeout));
      break;
    case CallKind::Stop:
      m_game.stopped = true;
      report(EventKind::PlayStopped);
      break;
    case CallKind::GoOn:
      if (m_game.restart.step == Restart::Step::Placing)
        nextStep();
      else
        m_game.stopped = false;
      report(EventKind::PlayGoesOn);
      break;
    case CallKind::Automatic:
      m_world.settings.referee->automatic = call.value != 0;
      report(EventKind::SettingChanged, static_cast<int>(Setting::Rules));
      break;
  }
}

/// What the entry into each state changes.
void RefereeTable::carryOut(PlayState state) {
  switch (state) {
    case PlayState::Initial:
      nextHalf();
      break;
    case PlayState::Ready:
      if (m_game.phase == GamePhase::Timeout) {
        endTimeout();
        break;
      }
      beginReady(m_game.state == PlayState::Playing ? Game::noTeam : m_game.kickOff);
      break;
    case PlayState::Set:
      if (m_game.state == PlayState::Ready)
        enter(PlayState::Set);
      else
        beginShot();
      break;
    case PlayState::Playing:
      beginPlaying();
      break;
    case PlayState::Finished:
      if (m_game.phase == GamePhase::ShootOut)
        endShot();
      else
        finish();
      break;
    case PlayState::Standby:
    case PlayState::Unknown:
      break;
  }
}

}  // namespace pitchboard::sim
