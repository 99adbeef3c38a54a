// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/skills.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>

#include "soccer/arrival.h"
#include "soccer/kick_choice.h"

namespace pitchboard::link {
namespace {

using acts::turn;
using std::numbers::pi;

/// Where the rules put the ball of a set play that is the own team's, or from where a robot sees
/// all of the field between them.
Points searchPlaces(const WorldModel& world) {
  const sim::FieldSpec& field = world.field();
  const double l = field.halfLength(), w = field.halfWidth();
  const double areaX = l - field.goalAreaLength, areaY = field.goalAreaWidth / 2;
  if (world.setPlayIsOurs()) {
    switch (world.setPlay()) {
      case SetPlay::GoalKick:
        // The league's rules of 2021 put it on the halfway line, others at the area's corner.
        return {{0, w}, {0, -w}, {-areaX, areaY}, {-areaX, -areaY}};
      case SetPlay::CornerKick:
        return {{l, w}, {l, -w}};
      case SetPlay::PenaltyKick:
        return {{l - field.penaltyMarkDistance, 0}};
      case SetPlay::ThrowIn: {
        const Point& last = world.ballLastSeen();
        return {{std::clamp(last.x, -l, l), last.y > 0.0 ? w : -w}};
      }
      default:
        break;
    }
  }
  const double x = 0.28 * field.length, y = 0.22 * field.width;
  return {{0, 0}, {x, y}, {x, -y}, {-x, -y}, {-x, y}};
}

}  // namespace

std::optional<Target> walkTo(const WorldModel& world, const Pose& pose, double near, double facing,
                             Ball ball) {
  Target target{pose, near, facing, {}};
  if (target.isReached(world.pose())) return std::nullopt;
  if (ball == Ball::KeepClear && world.seesBall()) target.ball = world.toField(world.ballInFront());
  return target;
}

Move Search::step(const WorldModel& world) {
  if (!m_since) begin(world);
  const double time = world.now() - *m_since;
  const double headTime = m_numbers->headTime, turnTime = m_numbers->turnTime;
  if (time < headTime) return acts::gait;
  // A robot that knows where to look does not turn.
  const double turns = m_lost ? 0.0 : turnTime;
  if (time < headTime + turns || !world.localized()) return acts::turnRight;
  return walk(world, time - headTime - turns);
}

void Search::begin(const WorldModel& world) {
  constexpr double clue = 30.0;  // s: where it was before that says nothing
  m_since = world.now();
  m_lost.reset();
  m_first = 0;
  const bool placed = world.setPlayIsOurs() && world.setPlay() != SetPlay::None;
  if (world.ballAge() > clue && !placed) return;
  if (placed) {
    const auto all = searchPlaces(world);
    m_lost = *std::ranges::min_element(
        all, {}, [&world](const Point& place) { return distance(place, world.ballLastSeen()); });
  } else {
    m_lost = world.ballLastSeen();
  }
  m_patience = 10.0 + 1.5 * distance(world.pose().position, *m_lost) / walkingSpeed(world);
  const auto places = searchPlaces(world);
  const auto nearest = std::ranges::min_element(places, [this](const Point& a, const Point& b) {
    return distance(a, *m_lost) < distance(b, *m_lost);
  });
  m_first = static_cast<std::size_t>(nearest - places.begin());
}

/// `time`: s since it began to walk.
Move Search::walk(const WorldModel& world, double time) {
  constexpr double near = 0.4;
  const double placeTime = m_numbers->placeTime;
  // Looking where it goes: straight behind itself the head does not see.
  const auto walkThere = [&world](const Point& place) {
    return walkTo(world, {place, direction(world.pose().position, place)}, near, pi, Ball::Ignore);
  };
  if (m_lost) {
    const auto target = walkThere(*m_lost);
    if (target && time < m_patience) return *target;
    m_lost.reset();
    m_since = world.now() - m_numbers->headTime;  // looks about there
    return acts::turnRight;
  }
  const auto places = searchPlaces(world);
  const auto i = (m_first + static_cast<std::size_t>(time / placeTime)) % places.size();
  if (const auto target = walkThere(places[i])) return *target;
  return acts::turnRight;
}

Move Attack::step(const WorldModel& world, const Point& aim, bool clears) {
  m_clears = clears;
  const Point local = world.ballInFront();
  const Point ball = world.toField(local);
  const double yaw = world.pose().yaw;
  // Without a pose the IMU still knows where the opponents' goal is.
  const double error =
      world.localized() ? wrapToPi(direction(ball, aim) - yaw) : wrapToPi(-world.imuYaw());
  const double d = world.ballDistance(), bearing = world.ballBearing();
  const double goalDistance = distance(ball, aim);
  m_held = heldFor(world, ball);
  const double goodEnough = tolerance(world, ball, goalDistance);

  // All distances of BehaviourParameters are beyond that at which the body touches the ball.
  const double touch = world.touch();
  const double begin = m_numbers->attackDistance, end = std::max(0.43, begin);
  const bool enter = d < touch + begin && std::abs(error) < 0.9 && std::abs(bearing) < 0.8;
  const bool stay = d < touch + end && std::abs(error) < 1.5 && std::abs(bearing) < 1.2;
  m_engaged = m_engaged ? stay : enter;
  if (m_engaged) return atBall(world, error, goodEnough);
  m_aligned = false;

  const double kickYaw = yaw + error;
  const double back = touch + m_numbers->behindBall;
  const Point behind{ball.x - back * repeatable::cos(kickYaw),
                     ball.y - back * repeatable::sin(kickYaw)};
  const auto target = walkTo(world, {behind, kickYaw}, 0.08, 0.5, Ball::KeepClear);
  if (target) return *target;
  return atBall(world, error, goodEnough);
}

/// How far from the aim is good enough.
double Attack::tolerance(const WorldModel& world, const Point& ball, double goalDistance) const {
  // From where a kick does not reach the goal.
  const double far = std::max(3.0, kickRange(world, acts::kickRight));  // m
  const double opening = repeatable::atan2(0.35 * world.field().goalWidth, goalDistance);
  double enough = goalDistance > far ? m_numbers->aimFar : opening;
  enough = std::min(std::max(enough, m_numbers->aimLeast), m_numbers->aimMost);
  // An opponent at the ball leaves no time: forward is good enough.
  for (const Point& opponent : world.opponents()) {
    if (distance(opponent, ball) < m_numbers->pressedWithin) {
      enough = std::max(enough, m_numbers->aimPressed);
    }
  }
  // A robot that has stood at the ball for long accepts a worse direction.
  constexpr double most = pi / 3;
  const double half = 0.5 * m_numbers->atBallTime;
  const double share = std::clamp((m_held - half) / half, 0.0, 1.0);
  return std::max(enough, share * most);
}

double Attack::heldFor(const WorldModel& world, const Point& ball) {
  constexpr double away = 0.4;  // m that the ball has got away
  if (distance(ball, m_heldAt) > away || world.ballDistance() > world.touch() + away) {
    m_heldAt = ball;
    m_heldSince = world.now();
  }
  return world.now() - m_heldSince;
}

/// From where this robot's foot hits the ball surely, m between the centres.
double Attack::kicksFrom(const WorldModel& world) const {
  constexpr double surely = 0.06;  // m inside the foot's reach
  const double near = world.touch() + m_numbers->kickDistance;
  if (world.body().kickLaw == sim::KickLaw::Published) return near;
  return std::max(near, world.body().kickReach - surely);
}

Act Attack::atBall(const WorldModel& world, double error, double tolerance) {
  const double d = world.ballDistance(), bearing = world.ballBearing();
  if (std::abs(error) < 0.6 * tolerance) m_aligned = true;
  if (std::abs(error) > tolerance) m_aligned = false;
  if (d < kicksFrom(world) && world.ballAge() < 0.3) {
    if (const auto kicks = kick(world)) return *kicks;
  }
  if (!m_aligned) {
    if (std::abs(bearing) > 0.45) return turn(bearing);
    if (d > world.touch() + 0.2) return acts::forwardSlow;
    if (d < world.touch() + 0.015) return acts::backwardSlow;
    return error > 0.0 ? acts::aroundRight : acts::aroundLeft;
  }
  if (std::abs(bearing) > m_numbers->kickBearing) {
    return world.ballInFront().y > 0.0 ? acts::sidleLeft : acts::sidleRight;
  }
  return acts::forward;
}

/// With the foot on the ball's side, where it is aligned and a ball that is kicked rolls no farther
/// than it can follow; else what is best.
std::optional<Act> Attack::kick(const WorldModel& world) const {
  constexpr double follows = 1.0;  // m
  const bool right = world.ballBearing() <= 0.0;
  const Act strong = right ? acts::kickRight : acts::kickLeft;
  const bool facesOwnGoal = std::abs(world.localized() ? world.pose().yaw : world.imuYaw()) > 1.7;
  if (kickRange(world, strong) <= follows) {
    const bool placed = m_aligned && std::abs(world.ballBearing()) <= m_numbers->kickBearing;
    return placed && !facesOwnGoal ? std::optional(strong) : std::nullopt;
  }
  if (!world.localized()) return std::nullopt;
  const KickSituation situation{world.toField(world.ballInFront()), m_clears,
                                m_held > m_numbers->atBallTime};
  // A robot that has stood at the ball for too long kicks as it stands.
  const auto best = chooseKick(world, *m_numbers, situation);
  return best ? std::optional(best->act) : std::nullopt;
}

Point aimFrom(const WorldModel& world, const Point& ball, double aimSide) {
  const sim::FieldSpec& field = world.field();
  const double middle = goalPart(world, aimSide).middle, part = 1.0 - std::abs(aimSide);
  const Points& opponents = world.opponents();
  const double heading = world.localized() ? world.pose().yaw : world.imuYaw();
  Point best = world.opponentGoal();
  double least = 1e9;
  // A ball that lies on the goal line is not to come back from it.
  constexpr double close = 0.3;  // m
  const bool onTheLine =
      ball.x > field.halfLength() - close && std::abs(ball.y) < field.goalWidth / 2;
  const double depth = onTheLine ? 2 * close : 0.0;
  const auto opponentsAhead = [&](double kickYaw) {
    double cost = 0.0;
    for (const Point& opponent : opponents) {
      const double d = distance(ball, opponent);
      const double off = std::abs(wrapToPi(direction(ball, opponent) - kickYaw));
      if (d > 0.3 && d < 2.0 && off < 0.5) cost += 2.0 * (0.5 - off);
    }
    return cost;
  };
  // Far from the ball, around robots in the way.
  constexpr double far = 4.5;  // m
  if (distance(ball, world.opponentGoal()) > far) {
    const double straight = direction(ball, {field.halfLength(), middle});
    for (int i = -2; i <= 2; ++i) {
      const double kickYaw = straight + 0.4 * i;
      const auto [s, c] = repeatable::sinCos(kickYaw);
      const Point aim{ball.x + 2.0 * c, ball.y + 2.0 * s};
      const bool inside = std::abs(aim.y) < field.halfWidth() - 0.4;
      const double cost = 0.15 * std::abs(i) + 0.3 * std::abs(wrapToPi(kickYaw - heading)) +
                          opponentsAhead(kickYaw) + (inside ? 0.0 : 1.0);
      if (cost >= least) continue;
      least = cost;
      best = aim;
    }
    return best;
  }
  for (int i = -2; i <= 2; ++i) {
    const Point aim{field.halfLength() + depth, i * 0.16 * field.goalWidth * part + middle};
    const double kickYaw = direction(ball, aim);
    const double cost =
        0.3 * std::abs(i) + std::abs(wrapToPi(kickYaw - heading)) + opponentsAhead(kickYaw);
    if (cost < least) {
      least = cost;
      best = aim;
    }
  }
  return best;
}

}  // namespace pitchboard::link
