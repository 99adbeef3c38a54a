// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numbers>

#include "referee_table.h"

namespace pitchboard::sim {
namespace {

constexpr double spotSpacing = 0.6;  // m between robots that wait beside the field
constexpr double occupied = 0.35;    // m
constexpr double comingBack = 2.0;   // times as long outside as who left the field

bool escalating(PenaltyKind penalty) {
  switch (penalty) {
    case PenaltyKind::MotionInStop:
    case PenaltyKind::Holding:
    case PenaltyKind::Leaving:
    case PenaltyKind::Hands:
    case PenaltyKind::Pushing:
    case PenaltyKind::Cautioned:
      return true;
    default:
      return false;
  }
}

bool isForGood(PenaltyKind penalty) {
  return penalty == PenaltyKind::SentOff || penalty == PenaltyKind::Substitute ||
         penalty == PenaltyKind::Manual;
}

}  // namespace

int RefereeTable::removalTicks(std::size_t robot, PenaltyKind penalty) const {
  if (isForGood(penalty)) return 0;
  if (staysOnField(penalty)) return ticks(m_rules.motionTime);
  if (m_game.phase == GamePhase::ShootOut && player(robot)->goalkeeper) {
    return ticks(m_rules.shotKeeperTime);
  }
  const GameTeam& team = m_game.teams[static_cast<std::size_t>(teamOf(robot))];
  const double more = m_rules.escalates ? m_rules.removalMore * team.penalties : 0.0;
  return ticks(m_rules.removalTime + more);
}

void RefereeTable::penalise(std::size_t robot, PenaltyKind penalty) {
  GamePlayer* one = player(robot);
  if (!one || one->penalty == PenaltyKind::SentOff) return;
  GameTeam& team = m_game.teams[static_cast<std::size_t>(teamOf(robot))];
  one->penalty = penalty;
  one->sinceTicks = 0;
  one->ticksLeft = removalTicks(robot, penalty);
  one->counting = m_rules.countsFromCall || staysOnField(penalty);
  one->outside = false;
  if (m_rules.escalates && escalating(penalty)) ++team.penalties;
  RobotWatch& watch = m_memory.watches[robot];
  watch.downTicks = watch.outsideTicks = watch.contactTicks = 0;
  report(EventKind::Penalised, static_cast<int>(penalty), m_world.robots[robot].id);
  // The assistant needs a while; where penalties count from the call, none is needed.
  if (m_rules.placedAfter <= 0.0 && !staysOnField(penalty)) putOutside(robot);
}

/// A robot that returns from outside the field is not leaving it until it has been inside.
void RefereeTable::comesBack(std::size_t robot) {
  RobotWatch& watch = m_memory.watches[robot];
  watch = {};
  watch.setPose = m_now.robots[robot].pose;
  watch.backTicks = 0;
  watch.outsideTicks = -ticks(comingBack * m_rules.leavingTime);
}

void RefereeTable::pardon(std::size_t robot) {
  freeOfPenalty(*player(robot));
  comesBack(robot);
  report(EventKind::PenaltyOver, 0, m_world.robots[robot].id);
}

void RefereeTable::pardonAll(int sinceTicks) {
  for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
    const GamePlayer* one = player(i);
    if (!one || one->penalty == PenaltyKind::None || isForGood(one->penalty)) continue;
    if (one->sinceTicks < sinceTicks) continue;
    pardon(i);
  }
}

/// Beside the touch line that is away from the ball, in the own half, where it comes back.
void RefereeTable::putOutside(std::size_t robot) {
  GamePlayer& one = *player(robot);
  one.outside = true;
  const double own = -attackSign(teamOf(robot));
  const double x = m_conduct.waitsAtHalfway
                       ? own * 0.5
                       : own * std::max(0.5, m_field.halfLength() - m_field.penaltyMarkDistance);
  const double side = ball().y > 0.0 ? -1.0 : 1.0;
  const double beyond = std::max(radiusOf(robot) + 0.02, m_field.border * 0.6);
  const double y = side * (m_field.halfWidth() + beyond);
  const int spots = static_cast<int>(std::abs(x) / spotSpacing) + 1;
  Point spot{x, y};
  for (int k = 0; k < 2 * spots; ++k) {
    // Towards the halfway line, then towards the goal line.
    const double step = k < spots ? -k : k - spots + 1;
    spot = {x + own * step * spotSpacing, y};
    bool free = true;
    for (std::size_t other = 0; free && other < m_world.robots.size(); ++other) {
      free = other == robot || !within(place(other), spot, occupied);
    }
    if (free) break;
  }
  putRobot(robot, {spot, -side * std::numbers::pi / 2.0});
}

void RefereeTable::runPenalties() {
  if (m_game.phase == GamePhase::Timeout) return;
  const bool setPlay = m_game.restart.isAnnounced() && m_rules.clockStopsInSetPlays;
  const bool counted = (m_game.state == PlayState::Playing && !setPlay) ||
                       m_game.state == PlayState::Ready ||
                       (m_game.state == PlayState::Set && m_conduct.penaltiesCountInSet);
  const bool runs = m_rules.countsAlways || (counted && !m_game.stopped);
  for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
    GamePlayer* one = player(i);
    if (!one || one->penalty == PenaltyKind::None) continue;
    ++one->sinceTicks;
    if (!staysOnField(one->penalty) && !one->outside &&
        one->sinceTicks >= ticks(m_rules.placedAfter)) {
      putOutside(i);
      one->counting = true;
    }
    if (isForGood(one->penalty) || !one->counting || !runs || m_memory.obeyed) continue;
    if (one->ticksLeft > 0) --one->ticksLeft;
    if (one->ticksLeft > 0 || (!m_rules.automatic && m_rules.countsAlways)) continue;
    pardon(i);
  }
}

}  // namespace pitchboard::sim
