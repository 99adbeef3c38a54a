// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numbers>

#include "referee_table.h"

namespace pitchboard::sim {
namespace {

constexpr double finishedAtLeast = 0.5;  // s, so that robots hear it
constexpr double betweenShots = 3.0;     // s

}  // namespace

bool RefereeTable::plays(std::size_t robot) const {
  const GamePlayer* one = player(robot);
  return one && one->penalty == PenaltyKind::None;
}

const GamePlayer* RefereeTable::player(std::size_t robot) const {
  const RobotIdentity& identity = m_world.robots[robot];
  return std::as_const(m_game).player(identity.team, identity.number);
}

GamePlayer* RefereeTable::player(std::size_t robot) {
  return const_cast<GamePlayer*>(std::as_const(*this).player(robot));
}

Point RefereeTable::place(std::size_t robot) const {
  for (const auto& [index, pose] : m_placements.robots) {
    if (index == robot) return pose.position;
  }
  return m_now.robots[robot].pose.position;
}

Point RefereeTable::clamped(const Point& p, double inside) const {
  const double x = std::max(0.0, m_field.halfLength() - inside);
  const double y = std::max(0.0, m_field.halfWidth() - inside);
  return {std::clamp(p.x, -x, x), std::clamp(p.y, -y, y)};
}

void RefereeTable::putBall(const Point& place) {
  m_placements.ball = place;
  m_memory.still = m_memory.near = {place, 0};
  m_memory.aloneTicks = 0;
}

void RefereeTable::enter(PlayState state) {
  m_game.state = state;
  m_game.stateTicks = 0;
  m_game.countdown = {};
  m_game.hidden = 0;
  m_game.stopped = false;
  if (state == PlayState::Ready || state == PlayState::Set) {
    for (std::size_t i = 0; i < m_memory.watches.size(); ++i) {
      m_memory.watches[i].setPose = m_now.robots[i].pose;
      m_memory.watches[i].stillTicks = 0;
    }
  }
  report(EventKind::PlayStateChanged, static_cast<int>(state));
}

void RefereeTable::beginReady(int kickOff) {
  enter(PlayState::Ready);
  m_game.kickOff = kickOff;
  m_game.countdown = {ticks(m_rules.readyTime), true};
  m_game.dropIn = {};
  m_memory.touch = {};
  freeBall({});
}

/// Nobody has it alone, wherever it is put.
void RefereeTable::freeBall(const Point& place) {
  putBall(place);
  m_game.restart = {};
}

void RefereeTable::beginPlaying() {
  enter(PlayState::Playing);
  m_game.beginClock();
  m_game.hidden = ticks(m_rules.playingHidden);
  using Step = Restart::Step;
  if (m_game.phase == GamePhase::ShootOut) {
    m_game.restart = {Step::Executed, SetPlay::PenaltyKick, m_game.shooter, ball(), 0, true, false};
    return;
  }
  if (m_game.setPlay() == SetPlay::PenaltyKick) {
    m_game.restart = {Step::Taking, SetPlay::PenaltyKick, m_game.restart.team, ball(), 0, true,
                      false};
    m_game.countdown = {ticks(m_rules.penaltyKickTime), true};
    return;
  }
  if (m_game.kickOff >= 0) {
    m_game.countdown = {ticks(m_rules.kickOffTime), true};
    m_game.restart = {Step::Executed,       SetPlay::None, m_game.kickOff, ball(), 0,
                      !m_rules.directGoals, false};
  }
  // All at SET -> PLAYING, but not who is penalised at this whistle.
  if (m_rules.pardonsAtPlay) pardonAll(1);
}

void RefereeTable::finish() {
  enter(PlayState::Finished);
  m_game.restart = {};
  m_game.breakLeft = ticks(std::max(m_rules.breakTime, m_rules.beforeHalf));
  if (m_game.half == 1) m_game.countdown = {ticks(m_rules.breakTime), true};
  pardonAll();
}

/// A countdown that does not run cannot end it.
bool RefereeTable::timeoutIsOver() const {
  return m_game.countdown.runs ? m_game.countdown.ticks <= 0
                               : m_game.stateTicks >= ticks(m_rules.timeoutTime);
}

/// The game goes on in the phase before: with READY, or the first shot.
void RefereeTable::endTimeout() {
  m_game.phase = m_game.phaseBefore;
  report(EventKind::PhaseChanged, static_cast<int>(m_game.phase));
  if (m_game.phase == GamePhase::ShootOut) {
    beginShot();
  } else {
    beginReady(m_game.kickOff);
  }
}

void RefereeTable::changeSides() {
  if (!m_rules.changeSides) return;
  swapSides(m_world);
  for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
    if (teamOf(i) < 0) continue;
    // All robots are placed at once, so that none is in the way.
    const Pose& pose = m_now.robots[i].pose;
    const double yaw = std::remainder(pose.yaw + std::numbers::pi, 2.0 * std::numbers::pi);
    putRobot(i, {{-pose.position.x, -pose.position.y}, yaw});
  }
  mirror();
}

int RefereeTable::kickingOff(int half) const {
  return half == 1 ? m_game.firstKickOff : 1 - m_game.firstKickOff;
}

void RefereeTable::nextHalf() {
  const Game::Countdown shown = m_game.countdown;
  if (m_game.half == 1) {
    m_game.half = 2;
  } else {
    m_game.half = 1;
    m_game.phase = GamePhase::ExtraTime;
    report(EventKind::PhaseChanged, static_cast<int>(m_game.phase));
  }
  enter(PlayState::Initial);
  m_game.countdown = shown;
  m_game.clock =
      ticks(m_game.phase == GamePhase::ExtraTime ? m_rules.extraHalfTime : m_rules.halfTime);
  m_game.clockUse = ClockUse::Full;
  m_game.kickOff = kickingOff(m_game.half);
  for (GameTeam& team : m_game.teams) team.timeouts = 0;
  report(EventKind::HalfBegan, m_game.half);
  changeSides();
  freeBall({});
}

void RefereeTable::beginPhase(GamePhase phase) {
  m_game.phase = phase;
  report(EventKind::PhaseChanged, static_cast<int>(phase));
  enter(PlayState::Initial);
  m_game.half = 2;
  m_game.clock = ticks(m_rules.shotTime);
  m_game.clockUse = ClockUse::Full;
  m_game.shooter = Game::noTeam;
  m_game.breakLeft = ticks(m_rules.beforeHalf);
  pardonAll();
  freeBall({});
}

bool RefereeTable::clockRuns() const {
  if (m_game.phase == GamePhase::Timeout) return false;
  const bool setPlay = m_game.restart.isAnnounced() && m_rules.clockStopsInSetPlays;
  switch (m_game.state) {
    case PlayState::Playing:
      return !setPlay;
    case PlayState::Ready:
    case PlayState::Set:
      return m_game.clockUse != ClockUse::Full && m_game.phase != GamePhase::ShootOut;
    default:
      return false;
  }
}

void RefereeTable::runClocks() {
  ++m_game.stateTicks;
  if (clockRuns()) --m_game.clock;
  // What waits waits while play is stopped; a break and a timeout run on.
  const bool waits =
      m_game.stopped && m_game.state != PlayState::Finished && m_game.state != PlayState::Initial;
  if (m_game.countdown.runs && !waits) {
    const bool below = m_game.state == PlayState::Initial && m_conduct.countsBelowZero;
    if (m_game.countdown.ticks > 0 || below) --m_game.countdown.ticks;
  }
  if (m_game.hidden > 0) --m_game.hidden;
  if (m_game.breakLeft > 0) --m_game.breakLeft;
  if (m_game.dropIn.ticks >= 0) ++m_game.dropIn.ticks;
  if (m_memory.touch.robot != 0) ++m_memory.touch.ticks;
}

/// What goes on by itself, by timers of the rules or of the automatic referee.
void RefereeTable::whistle() {
  if (m_memory.obeyed) return;
  const bool automatic = m_rules.automatic;
  // A half that has begun also runs out while robots walk to their places.
  const bool waits = m_game.state == PlayState::Ready || m_game.state == PlayState::Set;
  if (automatic && waits && clockRuns()) {
    judgeHalf();
    if (m_game.state == PlayState::Finished) return;
  }
  switch (m_game.state) {
    case PlayState::Initial:
      if (automatic && m_game.phase == GamePhase::Timeout) {
        if (timeoutIsOver()) endTimeout();
        break;
      }
      if (!automatic || m_game.breakLeft > 0) break;
      if (m_game.phase == GamePhase::ShootOut) {
        beginShot();
      } else {
        beginReady(m_game.kickOff);
      }
      break;
    case PlayState::Ready:
      if (m_game.countdown.ticks <= 0 || (automatic && allStandReady())) enter(PlayState::Set);
      break;
    case PlayState::Set: {
      const bool shot = m_game.phase == GamePhase::ShootOut;
      if (!automatic || m_game.stateTicks < ticks(shot ? m_rules.shotSetTime : m_rules.setTime)) {
        break;
      }
      if (m_rules.kickOffPositions && !shot) judgeKickOff();
      beginPlaying();
      break;
    }
    case PlayState::Playing:
      if (m_game.restart.isAnnounced()) {
        judgeSetPlay();
      } else if (m_game.countdown.runs && m_game.countdown.ticks <= 0) {
        m_game.countdown.runs = false;
        m_game.restart.step = Restart::Step::Free;
      }
      break;
    case PlayState::Finished:
      if (automatic && !m_game.over) afterFinished();
      break;
    case PlayState::Standby:
    case PlayState::Unknown:
      break;
  }
}

void RefereeTable::afterFinished() {
  const bool tie = m_game.teams[0].score == m_game.teams[1].score;
  if (m_game.phase == GamePhase::ShootOut) {
    if (shootOutDecided(m_game, m_rules)) {
      m_game.over = true;
    } else if (m_game.stateTicks >= ticks(betweenShots)) {
      beginShot();
      return;
    }
  } else if (m_game.half == 1) {
    const int wait = ticks(std::max(finishedAtLeast, m_rules.breakTime / 2.0));
    if (m_game.stateTicks >= wait) nextHalf();
    return;
  } else if (m_rules.knockout && tie) {
    if (m_game.stateTicks < ticks(finishedAtLeast)) return;
    if (m_rules.extraTime && m_game.phase == GamePhase::Normal) {
      nextHalf();
    } else {
      beginPhase(GamePhase::ShootOut);
    }
    return;
  } else {
    m_game.over = true;
  }
  if (!m_game.over) return;
  if (const auto winner = tossWinner(m_world)) report(EventKind::CoinToss, *winner);
  report(EventKind::FinalWhistle);
}

/// What every display of a match reads.
void RefereeTable::mirror() {
  const std::size_t left = m_game.leftTeam();
  m_world.score = {m_game.teams[left].score, m_game.teams[1 - left].score};
  m_world.clockRunning = m_game.state == PlayState::Playing && clockRuns();
}

void RefereeTable::tick(const BallSweep& sweep) {
  runClocks();
  runPenalties();
  if (m_game.state == PlayState::Playing) {
    judge(sweep);
  } else if (m_rules.automatic && m_game.state == PlayState::Set && m_rules.motionInSet > 0.0) {
    judgeRobots();
  }
  whistle();
  mirror();
}

}  // namespace pitchboard::sim
