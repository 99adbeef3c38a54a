// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <numbers>

#include <base/repeatable_math.h>

#include "referee_table.h"

namespace pitchboard::sim {
namespace {

constexpr double touchMargin = 0.012;   // m between two bodies that touch
constexpr double contactMargin = 0.02;  // m, robots
constexpr double pushersReach = 2.0;    // m to the ball
constexpr double pushersLead = 0.1;     // m that the pushed one is nearer to the ball
constexpr double pushingSpeed = 0.05;   // m/s towards the other, that its gait asks for
constexpr double immunity = 2.0;        // s after a pushing was given
constexpr double foulNearBall = 1.0;    // m: a free kick, else only removal
constexpr double alone = 1.0;           // m
constexpr double heap = 0.1;            // m that the ball moves in a heap of robots
constexpr double afterHeap = 10.0;      // s more, once a robot was removed from a heap
constexpr double longBack = 30.0;       // s of play after a penalty, on its way back
constexpr double oneTouch = 0.2;        // s; a shorter pause is none
constexpr double takenAway = 0.1;       // m that the ball of a set play has moved before a second
constexpr int fewPlayers = 3;           // a team of fewer may touch the ball twice
constexpr double enteredFor = 1.0;      // s in a crowded goal area
constexpr double stands = 0.02;         // m that a robot moves which stands
constexpr double standsTurned = 0.1;    // rad
constexpr double clearTime = 10.0;      // s to leave the ball of a set play
constexpr double atRest = 0.01;         // m/s
constexpr double maxEnd = 10.0;         // s that a half waits for the ball

}  // namespace

void RefereeTable::judge(const BallSweep& sweep) {
  followTouches(sweep);
  const PlayState before = m_game.state;
  if (m_rules.goals && judgeLines(sweep)) return;
  if (m_game.state != before || !m_rules.automatic) return;
  if (!m_game.restart.isAnnounced()) judgeRest();
  if (m_game.state != PlayState::Playing) return;
  judgeRobots();
  if (m_game.state == PlayState::Playing) judgeHalf();
}

/// Finds the robot that has the ball: the one that kicked in this tick, else the nearest that
/// touches it.
void RefereeTable::followTouches(const BallSweep&) {
  Restart& restart = m_game.restart;
  const bool placed = restart.step != Restart::Step::Placing;
  std::optional<std::size_t> toucher;
  double nearest = touchMargin;
  for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
    const double d = std::sqrt(squared(m_now.robots[i].pose.position, m_now.ball));
    const double gap = d - radiusOf(i) - m_field.ballRadius;
    if (gap < nearest && teamOf(i) >= 0) {
      nearest = gap;
      toucher = i;
    }
  }
  for (const Event& event : m_events) {
    if (event.kind != EventKind::Kick) continue;
    for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
      if (m_world.robots[i].id == event.robot && teamOf(i) >= 0) toucher = i;
    }
  }
  if (toucher) {
    const int team = teamOf(*toucher);
    const int id = m_world.robots[*toucher].id.value;
    const bool begins = m_memory.touch.robot != id;
    const bool again = !begins && m_memory.touch.ticks > ticks(oneTouch);
    m_memory.touch = {id, team, 0};
    if (again) judgeDoubleTouch(*toucher);
    if (restart.kicker == 0 && team == restart.team) {
      restart.kicker = id;
      restart.onlyTaker = true;
    }
    if (restart.kicker != 0 && restart.kicker != id) {
      restart.passed = true;
      restart.onlyTaker = false;
    }
    // A kick-off that left the circle may be shot by who took it.
    if (restart.kind == SetPlay::None &&
        !within(m_now.ball, {}, m_field.centreCircleDiameter / 2.0)) {
      restart.passed = true;
    }
    if (!m_game.ballFree() && placed && team != restart.team && restart.team >= 0 && begins &&
        m_rules.automatic && m_rules.exclusiveBall && plays(*toucher) &&
        m_game.phase != GamePhase::ShootOut) {
      penalise(*toucher, PenaltyKind::IllegalPosition);
    }
  }
  if (!m_memory.obeyed && !m_game.ballFree() && placed && restart.kicker != 0 &&
      !within(m_now.ball, restart.place, m_rules.inPlayDistance)) {
    inPlay();
  }
}

/// Judges a robot that took a set play and touches the ball again before any other robot.
void RefereeTable::judgeDoubleTouch(std::size_t robot) {
  const Restart& restart = m_game.restart;
  const bool judged = restart.kind == SetPlay::ThrowIn || restart.kind == SetPlay::GoalKick ||
                      restart.kind == SetPlay::CornerKick;
  if (!m_rules.doubleTouch || !m_rules.automatic || !judged || !restart.onlyTaker ||
      restart.kicker != m_world.robots[robot].id.value ||
      within(m_now.ball, restart.place, takenAway)) {
    return;
  }
  const int team = teamOf(robot);
  int players = 0;
  for (std::size_t i = 0; i < m_now.robots.size(); ++i) players += plays(i) && teamOf(i) == team;
  if (players >= fewPlayers) beginSetPlay(SetPlay::IndirectFreeKick, 1 - team, m_now.ball);
}

/// Goals and a ball that is out. True when play does not go on as it was.
bool RefereeTable::judgeLines(const BallSweep& sweep) {
  if (m_game.restart.step == Restart::Step::Placing) return false;  // the ball is dead
  std::array<Standing, highestRobotNumber> robots;
  const std::size_t count = std::min(robots.size(), m_now.robots.size());
  for (std::size_t i = 0; i < count; ++i) robots[i] = {m_now.robots[i].pose.position, radiusOf(i)};
  Crossing crossing = crossingOf(m_field, sweep, m_now.ball, std::span(robots).first(count));
  if (crossing.line == Crossing::Line::None) {
    if (isInField(m_field, m_now.ball)) return false;
    // Somebody put it there.
    crossing = {Crossing::Line::Touch, m_now.ball, m_now.ball.y > 0.0};
  }
  if (crossing.line == Crossing::Line::Goal) {
    judgeGoal(crossing.right, crossing.where);
    return true;
  }
  report(EventKind::BallOut);
  if (!m_rules.automatic) {
    // A person decides; the ball lies on the line meanwhile.
    putBall(clamped(crossing.where, 0.0));
    return true;
  }
  if (m_game.phase == GamePhase::ShootOut) {
    endShot();
    return true;
  }
  // If no robot touched the ball, the defenders get it; at the touch line the team that did not
  // kick off.
  const bool touchLine = crossing.line == Crossing::Line::Touch;
  const int right = static_cast<int>(m_game.swapped ? 0 : 1);  // defends the right goal
  const int defenders = crossing.right ? right : 1 - right;
  const int lastTouch = m_memory.touch.team >= 0 ? m_memory.touch.team
                        : touchLine              ? (crossing.where.x > 0.0 ? 1 - right : right)
                                                 : 1 - defenders;
  if (touchLine) {
    if (m_rules.throwIns) {
      beginSetPlay(SetPlay::ThrowIn, 1 - lastTouch, crossing.where);
    } else {
      freeBall(clamped(crossing.where, 1.0));
    }
  } else if (lastTouch == defenders && m_rules.cornerKicks) {
    beginSetPlay(SetPlay::CornerKick, 1 - defenders, crossing.where);
  } else if (lastTouch != defenders && m_rules.goalKicks) {
    beginSetPlay(SetPlay::GoalKick, defenders, crossing.where);
  } else {
    freeBall(clamped(crossing.where, 1.0));
  }
  return true;
}

void RefereeTable::judgeGoal(bool right, const Point& where) {
  const std::size_t scorer = right ? m_game.leftTeam() : 1 - m_game.leftTeam();
  const auto conceding = static_cast<int>(1 - scorer);
  if (!m_rules.automatic || m_game.phase == GamePhase::ShootOut) {
    goal(scorer);
    return;
  }
  // Straight from a kick-off, a throw-in or an indirect free kick it is none; into the own goal it
  // is a corner.
  const Restart& restart = m_game.restart;
  if (!restart.passed && restart.kicker != 0 && m_memory.touch.robot == restart.kicker) {
    report(EventKind::BallOut);
    if (m_memory.touch.team == static_cast<int>(scorer)) {
      beginSetPlay(SetPlay::GoalKick, conceding, where);
    } else {
      beginSetPlay(SetPlay::CornerKick, static_cast<int>(scorer), where);
    }
    return;
  }
  goal(scorer);
}

/// The ball lies still, no robot goes for it, or robots in a heap hide it.
void RefereeTable::judgeRest() {
  Game& g = m_game;
  if (g.phase == GamePhase::ShootOut) {
    if (g.clock <= 0) endShot();
    return;
  }
  const auto rest = [&](BallRest& at, double distance) {
    if (!within(m_now.ball, at.place, distance)) at = {m_now.ball, 0};
    ++at.ticks;
  };
  rest(m_memory.still, m_rules.stillDistance);
  rest(m_memory.near, heap);
  const auto isSomebodyWithin = [this](double reach) {
    for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
      if (plays(i) && within(m_now.robots[i].pose.position, m_now.ball, reach)) return true;
    }
    return false;
  };
  m_memory.aloneTicks = isSomebodyWithin(alone) ? 0 : m_memory.aloneTicks + 1;
  // It is stuck in a heap while robots are at it, and not while only one team may touch it.
  if (!g.ballFree() || !isSomebodyWithin(m_rules.localStuckReach)) {
    m_memory.near.ticks = std::min(m_memory.near.ticks, 0);
  }
  if (!m_rules.dropBalls) return;
  const auto over = [this](int passed, double time) { return time > 0.0 && passed >= ticks(time); };
  if (over(m_memory.near.ticks, m_rules.localStuckTime)) {
    std::optional<std::size_t> nearest;
    double least = m_rules.localStuckReach * m_rules.localStuckReach;
    for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
      const double d = squared(m_now.robots[i].pose.position, m_now.ball);
      if (!plays(i) || d > least || isReturning(i)) continue;
      least = d;
      nearest = i;
    }
    m_memory.near.ticks = nearest ? -ticks(afterHeap) : 0;
    if (nearest) {
      penalise(*nearest, PenaltyKind::LocalStuck);
      return;
    }
  }
  if (over(m_memory.still.ticks, m_rules.stillTime) ||
      over(m_memory.aloneTicks, m_rules.nobodyTime))
    dropBall();
}

void RefereeTable::judgeRobots() {
  const bool isSet = m_game.state == PlayState::Set;
  for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
    if (!plays(i)) continue;
    const RobotSnapshot& robot = m_now.robots[i];
    RobotWatch& watch = m_memory.watches[i];
    if (isSet) {
      if (!within(robot.pose.position, watch.setPose.position, m_rules.motionInSet) &&
          m_game.stateTicks > ticks(1.0)) {
        penalise(i, PenaltyKind::MotionInSet);
      } else if (m_game.stateTicks <= ticks(1.0)) {
        watch.setPose = robot.pose;
      }
      continue;
    }
    if (watch.backTicks >= 0 && ++watch.backTicks > ticks(longBack)) watch.backTicks = -1;
    watch.downTicks = !robot.fallen ? 0 : watch.downTicks + (robot.gettingUp ? 0 : 1);
    watch.areaTicks = isInOwnGoalArea(i) ? watch.areaTicks + 1 : 0;
    const double radius = radiusOf(i);
    const bool out = std::abs(robot.pose.position.x) > m_field.halfLength() + radius ||
                     std::abs(robot.pose.position.y) > m_field.halfWidth() + radius;
    // A robot that fetches the ball from the line may stand behind the line.
    const bool fetches = !m_game.ballFree();
    watch.outsideTicks = !out      ? 0
                         : fetches ? std::min(0, watch.outsideTicks)
                                   : watch.outsideTicks + 1;
    if (m_rules.fallenTime > 0.0 && watch.downTicks > ticks(m_rules.fallenTime)) {
      penalise(i, PenaltyKind::Incapable);
    } else if (m_rules.leavingTime > 0.0 && watch.outsideTicks > ticks(m_rules.leavingTime)) {
      penalise(i, PenaltyKind::Leaving);
    } else if (m_rules.pushingTime > 0.0) {
      judgePushing(i);
    }
    if (m_game.state != PlayState::Playing) return;
  }
  if (!isSet && m_rules.goalAreaMost > 0) judgeGoalAreas();
}

bool RefereeTable::isInOwnGoalArea(std::size_t robot) const {
  const Point& at = m_now.robots[robot].pose.position;
  return -attackSign(teamOf(robot)) * at.x > m_field.halfLength() - m_field.goalAreaLength &&
         std::abs(at.y) < m_field.goalAreaWidth / 2.0;
}

/// Of too many in their own goal area the last to enter goes.
void RefereeTable::judgeGoalAreas() {
  for (int team = 0; team < 2; ++team) {
    int inside = 0;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
      if (teamOf(i) != team || !plays(i) || m_memory.watches[i].areaTicks == 0) continue;
      ++inside;
      if (!last || m_memory.watches[i].areaTicks < m_memory.watches[*last].areaTicks) last = i;
    }
    if (inside > m_rules.goalAreaMost && m_memory.watches[*last].areaTicks > ticks(enteredFor)) {
      penalise(*last, PenaltyKind::IllegalPosition);
    }
  }
}

/// Touching an opponent that is nearer to the ball, and walking against it. Who turns in place or
/// kicks does not push.
void RefereeTable::judgePushing(std::size_t robot) {
  RobotWatch& watch = m_memory.watches[robot];
  if (watch.immuneTicks > 0) {
    --watch.immuneTicks;
    return;
  }
  const RobotSnapshot& pusher = m_now.robots[robot];
  const double toBall = std::sqrt(squared(pusher.pose.position, m_now.ball));
  // What its gait asks for: its body does not move when the other one stands firm.
  constexpr int fullSpeed = 10;  // DECISION_ACTION_B
  const GaitSpeed gait = gaitSpeed(m_world.models[robot], pusher.action, fullSpeed);
  const auto [s, c] = repeatable::sinCos(pusher.pose.yaw);
  const double vx = gait.forward * c - gait.left * s, vy = gait.forward * s + gait.left * c;
  bool pushes = false;
  for (std::size_t j = 0; j < m_now.robots.size() && toBall < pushersReach; ++j) {
    if (j == robot || teamOf(j) < 0 || teamOf(j) == teamOf(robot)) continue;
    const Point& other = m_now.robots[j].pose.position;
    const double touching = radiusOf(robot) + radiusOf(j) + contactMargin;
    if (!within(pusher.pose.position, other, touching)) continue;
    const double lead = toBall - std::sqrt(squared(other, m_now.ball));
    const double dx = other.x - pusher.pose.position.x, dy = other.y - pusher.pose.position.y;
    const double d = std::sqrt(dx * dx + dy * dy);
    const bool walksAtIt = d > 0.0 && (vx * dx + vy * dy) / d > pushingSpeed;
    pushes = pushes || (lead > pushersLead && walksAtIt);
  }
  watch.contactTicks = pushes ? watch.contactTicks + 1 : std::max(0, watch.contactTicks - 1);
  if (watch.contactTicks <= ticks(m_rules.pushingTime)) return;
  watch.contactTicks = 0;
  watch.immuneTicks = ticks(immunity);
  foul(robot, PenaltyKind::Pushing);
}

/// Near the ball in play a free kick, or a penalty kick before the own goal; else removal.
void RefereeTable::foul(std::size_t robot, PenaltyKind penalty) {
  const Point& at = m_now.robots[robot].pose.position;
  const int team = teamOf(robot);
  const bool near = within(at, m_now.ball, foulNearBall) && m_game.ballFree();
  if (!near || !m_rules.freeKicks || m_conduct.replacesBall) {
    penalise(robot, penalty);
    return;
  }
  const double depth = m_field.penaltyAreaLength > 0.0 ? m_field.penaltyAreaLength : 0.0;
  const bool before = -attackSign(team) * at.x > m_field.halfLength() - depth &&
                      std::abs(at.y) < m_field.penaltyAreaWidth / 2.0;
  beginSetPlay(before ? SetPlay::PenaltyKick : SetPlay::DirectFreeKick, 1 - team, m_now.ball);
}

bool RefereeTable::mayStandThere(std::size_t robot) {
  const Point at = place(robot);
  const int team = teamOf(robot);
  if (m_game.setPlay() == SetPlay::PenaltyKick) {
    return team == m_game.restart.team || player(robot)->goalkeeper ||
           !within(at, ball(), m_rules.distanceToBall);
  }
  const double circle = m_field.centreCircleDiameter / 2.0;
  const double radius = radiusOf(robot);
  const double forward = attackSign(team) * at.x;
  const bool inCircle = within(at, {}, circle + radius);
  const bool kicks = m_game.kickOff == team;
  const bool beyond = forward > -radius && !(kicks && inCircle);
  const bool outside = std::abs(at.x) > m_field.halfLength() + radius ||
                       std::abs(at.y) > m_field.halfWidth() + radius;
  const bool tooNear = !kicks && within(at, {}, circle);
  return !beyond && !outside && !tooNear;
}

/// In READY: everybody who plays has stood for a while where it may begin.
bool RefereeTable::allStandReady() {
  if (m_rules.readyStillTime <= 0.0) return false;
  bool all = true, any = false;
  for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
    if (!plays(i)) continue;
    const RobotSnapshot& robot = m_now.robots[i];
    RobotWatch& watch = m_memory.watches[i];
    const double turned = std::remainder(robot.pose.yaw - watch.setPose.yaw, 2 * std::numbers::pi);
    if (robot.fallen || std::abs(turned) > standsTurned ||
        !within(robot.pose.position, watch.setPose.position, stands)) {
      watch.setPose = robot.pose;
      watch.stillTicks = 0;
    } else {
      ++watch.stillTicks;
    }
    any = true;
    all = all && watch.stillTicks >= ticks(m_rules.readyStillTime) && mayStandThere(i);
  }
  return any && all;
}

/// At the whistle: who does not stand where it may begins beside the field.
void RefereeTable::judgeKickOff() {
  for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
    if (plays(i) && !isReturning(i) && !mayStandThere(i)) {
      penalise(i, PenaltyKind::IllegalPosition);
    }
  }
}

/// Came back from a penalty a short time ago: it may still be where others must not be.
bool RefereeTable::isReturning(std::size_t robot) const {
  return m_memory.watches[robot].backTicks >= 0;
}

/// A set play goes on by its timers; who stands at the ball when it may be taken is penalised.
void RefereeTable::judgeSetPlay() {
  if (!m_rules.automatic) return;
  const int passed = m_game.stateTicks;
  const auto clearBall = [this] {
    for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
      const int team = teamOf(i);
      if (!plays(i) || team == m_game.restart.team || isReturning(i)) continue;
      const bool keeper =
          player(i)->goalkeeper && -attackSign(team) * m_now.robots[i].pose.position.x >
                                       m_field.halfLength() - std::max(0.5, m_field.goalAreaLength);
      if (keeper || !within(m_now.robots[i].pose.position, m_now.ball, m_rules.distanceToBall)) {
        continue;
      }
      penalise(i, PenaltyKind::IllegalPosition);
    }
  };
  switch (m_game.restart.step) {
    case Restart::Step::Placing:
      if (passed >= ticks(m_rules.placingTime)) nextStep();
      break;
    case Restart::Step::Preparing:
      if (m_game.countdown.ticks > 0) break;
      if (m_rules.freeKicks) clearBall();
      nextStep();
      break;
    case Restart::Step::Taking:
      if (m_conduct.preparesSetPlays) {
        if (passed >= ticks(m_rules.readyStepTime)) nextStep();
        break;
      }
      if (m_rules.freeKicks && passed == ticks(clearTime) && m_game.state == PlayState::Playing &&
          m_game.restart.kind != SetPlay::PenaltyKick) {
        clearBall();
      }
      if (m_game.countdown.runs && m_game.countdown.ticks <= 0) inPlay();
      break;
    default:
      break;
  }
}

void RefereeTable::judgeHalf() {
  if (m_game.phase == GamePhase::ShootOut || m_game.setPlay() == SetPlay::PenaltyKick) return;
  if (!m_rules.halfEndsWithBall) {
    if (m_game.clock <= 0) finish();
    return;
  }
  if (m_game.clock >= 0) return;
  const Velocity& v = m_now.ballVelocity;
  const bool still = v.x * v.x + v.y * v.y < atRest * atRest && m_game.clock <= -ticks(1.0);
  if (still || m_game.clock <= -ticks(maxEnd)) finish();
}

}  // namespace pitchboard::sim
