// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include "referee_table.h"

namespace pitchboard::sim {
namespace {

tl::unexpected<Error> refused(const std::string& text) {
  return failure(ErrorCode::Conflict, text);
}

}  // namespace

Result<void> RefereeTable::call(const RefereeCall& call) {
  const auto robot = [&]() -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
      if (m_world.robots[i].id == call.robot && player(i)) return i;
    }
    return {};
  }();
  const bool needsTeam = call.kind == CallKind::Goal || call.kind == CallKind::SetPlay;
  if (call.team < GameState::nobody || call.team > 1 || (needsTeam && call.team < 0)) {
    return failure(ErrorCode::InvalidArgument, "The referee needs one of the two teams for this.");
  }
  if ((call.kind == CallKind::Penalise || call.kind == CallKind::Pardon ||
       call.kind == CallKind::Card) &&
      !robot) {
    return failure(ErrorCode::NotFound, "Robot " + std::to_string(call.robot.value) +
                                            " plays in neither of the two teams.");
  }
  const auto team = static_cast<std::size_t>(std::max(0, call.team));
  switch (call.kind) {
    case CallKind::State:
      return callState(call.state);
    case CallKind::KickOff:
      m_game.kickOff = call.team;
      break;
    case CallKind::Goal:
      if (call.value < 0) {
        if (m_game.teams[team].score == 0) return refused("This team has no goal to take back.");
        countGoal(team, -1);
        mirror();
        report(EventKind::ScoreCorrected, m_game.leftTeam() == team ? 0 : 1);
      } else if (m_game.state != PlayState::Playing && m_game.state != PlayState::Finished) {
        return refused("A goal can be given in PLAYING and FINISHED only.");
      } else {
        goal(team);
      }
      break;
    case CallKind::SetPlay:
      if (m_game.state != PlayState::Playing || m_game.phase == GamePhase::Timeout) {
        return refused("Set plays are given while the game is PLAYING.");
      }
      if (call.setPlay == SetPlay::None) {
        inPlay();
        break;
      }
      beginSetPlay(call.setPlay, call.team, call.place.value_or(m_now.ball));
      break;
    case CallKind::NextStep:
      if (!m_game.restart.isTold()) return refused("There is no set play to go on with.");
      nextStep();
      break;
    case CallKind::DropBall:
      if (m_game.state != PlayState::Playing)
        return refused("A drop ball is given in PLAYING only.");
      dropBall();
      break;
    case CallKind::Penalise:
      if (call.penalty == PenaltyKind::None) return refused("A penalty needs its reason.");
      penalise(*robot, call.penalty);
      break;
    case CallKind::Pardon:
      if (plays(*robot)) return refused("This robot is not penalised.");
      pardon(*robot);
      break;
    case CallKind::Card: {
      GamePlayer& one = *player(*robot);
      ++(call.value == 0 ? one.warnings : call.value == 1 ? one.yellow : one.red);
      if (one.warnings >= 2) one.warnings = 0, ++one.yellow;
      if (one.yellow >= 2) one.yellow = 0, ++one.red;
      if (one.red > 0) penalise(*robot, PenaltyKind::SentOff);
      break;
    }
    case CallKind::NextHalf:
      if (m_game.state != PlayState::Finished) return refused("A half follows FINISHED.");
      m_game.over = false;
      nextHalf();
      break;
    case CallKind::ShootOut:
      if (m_game.state != PlayState::Finished) return refused("The shoot-out follows FINISHED.");
      m_game.over = false;
      beginPhase(GamePhase::ShootOut);
      break;
    case CallKind::Timeout:
      if (m_game.state == PlayState::Finished || m_game.phase == GamePhase::Timeout ||
          (call.team >= 0 && m_game.state == PlayState::Playing)) {
        return refused("A timeout is taken in INITIAL, READY or SET.");
      }
      if (call.team >= 0 && m_game.teams[team].timeouts > 0) {
        return refused("This team has had its timeout.");
      }
      if (call.team >= 0) ++m_game.teams[team].timeouts;
      m_game.phaseBefore = m_game.phase;
      m_game.phase = GamePhase::Timeout;
      enter(PlayState::Initial);
      m_game.countdown = {ticks(call.team >= 0 ? m_rules.timeoutTime : m_rules.refereeTimeoutTime),
                          true};
      report(EventKind::PhaseChanged, static_cast<int>(GamePhase::Timeout));
      break;
    case CallKind::Stop:
      if (m_game.stopped) return refused("Play is stopped already.");
      m_game.stopped = true;
      report(EventKind::PlayStopped);
      break;
    case CallKind::GoOn:
      if (!m_game.stopped) return refused("Play is not stopped.");
      if (m_game.restart.step == Restart::Step::Placing) {
        nextStep();
      } else {
        m_game.stopped = false;
      }
      report(EventKind::PlayGoesOn);
      break;
    case CallKind::Automatic:
      m_world.settings.referee->automatic = call.value != 0;
      break;
  }
  return {};
}

/// The transitions of REFEREE.md section 1.
Result<void> RefereeTable::callState(PlayState state) {
  const PlayState from = m_game.state;
  const auto refuse = [&] {
    return refused("The referee cannot go from " + std::string(wordsOf(from)) + " to " +
                   std::string(wordsOf(state)) + ".");
  };
  switch (state) {
    case PlayState::Initial:
      if (from != PlayState::Finished) return refuse();
      nextHalf();
      return {};
    case PlayState::Ready:
      if (from != PlayState::Initial && from != PlayState::Playing) return refuse();
      if (m_game.phase == GamePhase::ShootOut) return refuse();
      if (m_game.phase == GamePhase::Timeout) {
        m_game.phase = m_game.phaseBefore;
        report(EventKind::PhaseChanged, static_cast<int>(m_game.phase));
      }
      beginReady(from == PlayState::Playing ? GameState::nobody : m_game.kickOff);
      return {};
    case PlayState::Set:
      if (m_game.phase == GamePhase::ShootOut &&
          (from == PlayState::Initial || from == PlayState::Finished)) {
        if (shootOutDecided()) return refused("The shoot-out is decided.");
        beginShot();
        return {};
      }
      if (from != PlayState::Ready) return refuse();
      enter(PlayState::Set);
      return {};
    case PlayState::Playing:
      if (from != PlayState::Set) return refuse();
      beginPlaying();
      return {};
    case PlayState::Finished:
      if (from == PlayState::Initial || from == PlayState::Finished) return refuse();
      if (m_game.phase == GamePhase::ShootOut) {
        endShot();
      } else {
        finish();
      }
      return {};
  }
  return refuse();
}

}  // namespace pitchboard::sim
