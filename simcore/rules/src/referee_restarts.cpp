// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "referee_table.h"

namespace pitchboard::sim {
namespace {

constexpr double replacedInside = 0.4;  // m inside the lines (Humanoid League until 2016)

}  // namespace

/// `goals`: 1, or −1 to take one back.
void RefereeTable::countGoal(std::size_t team, int goals) {
  GameTeam& scorer = m_game.teams[team];
  scorer.score += goals;
  const auto period = m_game.period();
  if (!period) return;
  // One that is taken back may have been shot in an earlier half.
  std::size_t half = *period;
  while (goals < 0 && half > 0 && scorer.byHalf[half] == 0) --half;
  scorer.byHalf[half] = std::max(0, scorer.byHalf[half] + goals);
}

void RefereeTable::goal(std::size_t team) {
  if (m_memory.obeyed) return;  // the GameController says whether it is one
  report(EventKind::Goal, m_game.leftTeam() == team ? 0 : 1);
  GameTeam& scorer = m_game.teams[team];
  countGoal(team, 1);
  mirror();
  if (m_game.phase == GamePhase::ShootOut) {
    if (m_game.state != PlayState::Playing) return;
    if (static_cast<int>(team) == m_game.shooter && scorer.penaltyShots >= 1) {
      scorer.singleShots |= 1 << std::min(15, scorer.penaltyShots - 1);
    }
    endShot();
    return;
  }
  if (m_game.state != PlayState::Playing) return;
  const int lead = std::abs(m_game.teams[0].score - m_game.teams[1].score);
  if (m_rules.mercy > 0 && lead >= m_rules.mercy) {
    m_game.half = 2;
    finish();
    return;
  }
  beginReady(static_cast<int>(1 - team));
}

Point setPlayPlace(SetPlay play, double sign, const Point& where, RefereeStyle style,
                   const FieldSpec& field) {
  const RefereeConduct conduct = conductOf(style);
  const bool replaced = conduct.replacesBall;
  const double inside = replaced ? replacedInside : 0.0;
  const double side = where.y < 0.0 ? -1.0 : 1.0;
  const double x = field.halfLength(), y = field.halfWidth();
  const auto onField = [&](const Point& p) {
    return Point{std::clamp(p.x, -x, x), std::clamp(p.y, -y, y)};
  };
  switch (play) {
    case SetPlay::ThrowIn: {
      // Until 2016 a metre back towards the goal of who put it out, and not into the goal areas.
      double at = std::clamp(where.x, -x, x);
      if (replaced) {
        const double most = std::max(0.0, x - field.goalAreaLength);
        at = std::clamp(at + sign, -most, most);
      }
      return {at, side * (y - inside)};
    }
    case SetPlay::GoalKick:
      if (conduct.goalKickAtArea) {
        return {-sign * (x - field.goalAreaLength), side * field.goalAreaWidth / 2.0};
      }
      return {0.0, side * (y - inside)};
    case SetPlay::CornerKick:
      return {sign * (replaced ? x - field.goalAreaLength : x), side * (y - inside)};
    case SetPlay::PenaltyKick:
      return {sign * (x - field.penaltyMarkDistance), 0.0};
    case SetPlay::IndirectFreeKick: {
      const double front = x - field.goalAreaLength;
      const bool inArea = where.x * sign > front && std::abs(where.y) < field.goalAreaWidth / 2.0;
      return onField(inArea ? Point{sign * front, where.y} : where);
    }
    default:
      return onField(where);
  }
}

void RefereeTable::beginSetPlay(SetPlay play, int team, const Point& place) {
  const Point where = setPlayPlace(play, attackSign(team), place, m_rules.style, m_field);
  report(EventKind::SetPlayBegan, static_cast<int>(play));
  if (m_conduct.replacesBall && play != SetPlay::PenaltyKick) {
    // The ball is put back, in play at once.
    freeBall(where);
    m_game.dropIn = {1 - team, 0};
    return;
  }
  const bool indirect = play == SetPlay::ThrowIn || play == SetPlay::IndirectFreeKick;
  m_game.restart = {
      Restart::Step::Placing, play, team, where, 0, !(m_rules.directGoals && indirect), false};
  m_game.hidden = 0;
  if (!m_conduct.preparesSetPlays) m_game.kickOff = team;
  if (play == SetPlay::PenaltyKick && m_rules.penaltyKickReady > 0.0) {
    enter(PlayState::Ready);
    m_game.countdown = {ticks(m_rules.penaltyKickReady), true};
    m_game.restart.step = Restart::Step::Preparing;
    ballPlaced();
    return;
  }
  m_game.stateTicks = 0;
  m_game.countdown = {};
  if (!m_conduct.preparesSetPlays) {
    m_game.stopped = true;
    m_game.countdown.ticks = ticks(m_rules.takeTime);
  }
}

/// Puts the ball where it is taken, and robots that stand on that place beside it.
void RefereeTable::ballPlaced() {
  const Point where = m_game.restart.place;
  putBall(where);
  for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
    const double room = radiusOf(i) + m_field.ballRadius + 0.1;
    const Point at = place(i);
    if (!within(at, where, room)) continue;
    const double dx = at.x - where.x, dy = at.y - where.y;
    const double d = std::sqrt(dx * dx + dy * dy);
    // A robot exactly on the place goes towards its own goal.
    const double nx = d > 1e-6 ? dx / d : (teamOf(i) >= 0 ? -attackSign(teamOf(i)) : 1.0);
    const double ny = d > 1e-6 ? dy / d : 0.0;
    putRobot(i, {{where.x + nx * room, where.y + ny * room}, m_now.robots[i].pose.yaw});
  }
}

/// Placing, preparing, taking, in play: with the steps that the style knows.
void RefereeTable::nextStep() {
  Restart& restart = m_game.restart;
  m_game.stateTicks = 0;
  switch (restart.step) {
    case Restart::Step::Placing:
      ballPlaced();
      if (m_conduct.preparesSetPlays) {
        restart.step = Restart::Step::Preparing;
        m_game.countdown = {ticks(m_rules.prepareTime), true};
      } else {
        m_game.stopped = false;
        restart.step = Restart::Step::Taking;
        m_game.countdown.runs = true;
      }
      return;
    case Restart::Step::Preparing:
      restart.step = Restart::Step::Taking;
      m_game.countdown = {};
      return;
    default:
      break;
  }
  if (!m_conduct.preparesSetPlays) {
    inPlay();
    return;
  }
  restart.step = Restart::Step::Executed;
  m_game.countdown = {ticks(m_rules.takeTime), true};
  report(EventKind::SetPlayOver);
}

/// The restart is taken.
void RefereeTable::inPlay() {
  if (m_game.setPlay() == SetPlay::PenaltyKick && m_rules.penaltyKickReady > 0.0 &&
      m_game.state == PlayState::Playing && m_game.hidden > 0) {
    return;  // robots do not know that it has begun
  }
  const bool announced = m_game.restart.isAnnounced();
  m_game.restart.step = Restart::Step::Free;
  if (!announced) return;
  m_game.stopped = false;
  m_game.countdown = {};
  report(EventKind::SetPlayOver);
}

void RefereeTable::dropBall() {
  report(EventKind::DropBall);
  beginReady(Game::noTeam);
}

/// The next shot of a shoot-out: kicker and keeper stand ready, everybody else is out.
void RefereeTable::beginShot() {
  if (m_game.shooter != Game::noTeam) {
    m_game.shooter = 1 - m_game.shooter;
    // Both teams shoot at the same goal. Nobody is carried over: who plays is placed, the others
    // wait outside.
    if (m_rules.changeSides) swapSides(m_world);
  } else {
    m_game.shooter = m_game.firstKickOff;
  }
  const int team = m_game.shooter;
  m_game.teams[static_cast<std::size_t>(team)].penaltyShots += 1;
  m_game.kickOff = team;
  m_game.clock = ticks(m_rules.shotTime);
  m_game.clockUse = ClockUse::Full;
  enter(PlayState::Set);
  const double mark = attackSign(team) * (m_field.halfLength() - m_field.penaltyMarkDistance);
  freeBall({mark, 0.0});
  bool kicks = false, keeps = false;
  for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
    GamePlayer* one = player(i);
    if (!one || one->penalty == PenaltyKind::SentOff) continue;
    const bool own = teamOf(i) == team;
    const bool chosen = own ? !kicks && !one->goalkeeper : !keeps && one->goalkeeper;
    if (!chosen) {
      if (one->penalty == PenaltyKind::None) penalise(i, PenaltyKind::Substitute);
      continue;
    }
    // A goalkeeper that was removed in the shoot-out misses the shots of its time.
    if (!own && one->penalty != PenaltyKind::None && one->ticksLeft > 0) continue;
    (own ? kicks : keeps) = true;
    freeOfPenalty(*one);
    m_memory.watches[i] = {};
    const double yaw = attackSign(teamOf(i)) > 0.0 ? 0.0 : 3.141592653589793;
    const double x =
        own ? mark - attackSign(team) * 0.6 : attackSign(team) * (m_field.halfLength() - 0.05);
    putRobot(i, {{x, 0.0}, yaw});
  }
}

void RefereeTable::endShot() {
  enter(PlayState::Finished);
  m_game.restart = {};
}

}  // namespace pitchboard::sim
