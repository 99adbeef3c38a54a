// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/skills.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>

namespace pitchboard::link {
namespace {

using acts::turn;
using std::numbers::pi;

/// From where a robot sees all of the field between them.
std::array<Point, 5> searchPlaces(const sim::FieldSpec& field) {
  const double x = 0.28 * field.length, y = 0.22 * field.width;
  return {{{0, 0}, {x, y}, {x, -y}, {-x, -y}, {-x, y}}};
}

/// How far the ball rolls that this kick hits, m.
double kickRange(const WorldModel& world, const Act& kick, const sim::BallAtFeet& ball) {
  const sim::FieldSpec& field = world.field();
  return sim::rollingDistance(field.surface,
                              sim::kickSpeed(world.body(), field.robotRadius, kick.action, ball));
}

/// Whether a ball that rolls so far along the robot's heading stays on the field or goes into the
/// opponents' goal.
bool staysIn(const WorldModel& world, const Point& ball, double range) {
  const sim::FieldSpec& field = world.field();
  const auto [s, c] = repeatable::sinCos(world.pose().yaw);
  const double toLine = field.halfLength() - ball.x;
  const bool shot = c > 0.0 && toLine < range * c;
  const double way = shot ? toLine / c : range;
  const double y = std::abs(ball.y + way * s);
  if (shot) return y < field.goalWidth / 2 - field.goalPostRadius - field.ballRadius;
  return y < field.halfWidth() && ball.x + way * c > -field.halfLength();
}

/// m/s
double forwardSpeed(const WorldModel& world) {
  return std::max(0.01,
                  sim::gaitSpeed(world.body(), acts::forward.action, acts::forward.b).forward);
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
  // Who knows where to look does not lose time with turning.
  const double turns = m_lost ? 0.0 : turnTime;
  if (time < headTime + turns || !world.localized()) return acts::turnRight;
  return walk(world, time - headTime - turns);
}

void Search::begin(const WorldModel& world) {
  constexpr double clue = 30.0;  // s: where it was before that says nothing
  m_since = world.now();
  m_lost.reset();
  m_first = 0;
  if (world.ballAge() > clue) return;
  m_lost = world.ballLastSeen();
  m_patience = 10.0 + 1.5 * distance(world.pose().position, *m_lost) / forwardSpeed(world);
  const auto places = searchPlaces(world.field());
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
  const auto places = searchPlaces(world.field());
  const auto i = (m_first + static_cast<std::size_t>(time / placeTime)) % places.size();
  if (const auto target = walkThere(places[i])) return *target;
  return acts::turnRight;
}

Move Attack::step(const WorldModel& world, const Point& aim) {
  const Point local = world.ballInFront();
  const Point ball = world.toField(local);
  const double yaw = world.pose().yaw;
  // Without a pose the IMU still knows where the opponents' goal is.
  const double error =
      world.localized() ? wrapToPi(direction(ball, aim) - yaw) : wrapToPi(-world.imuYaw());
  const double d = world.ballDistance(), bearing = world.ballBearing();
  const double goalDistance = distance(ball, aim);
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
  const double far =
      std::max(3.0, kickRange(world, acts::kickRight, {kicksFrom(world), 0.0}));  // m
  const double opening = repeatable::atan2(0.35 * world.field().goalWidth, goalDistance);
  double enough = goalDistance > far ? m_numbers->aimFar : opening;
  enough = std::min(std::max(enough, m_numbers->aimLeast), m_numbers->aimMost);
  // An opponent at the ball leaves no time: forward is good enough.
  for (const Point& opponent : world.opponents()) {
    if (distance(opponent, ball) < m_numbers->pressedWithin) {
      enough = std::max(enough, m_numbers->aimPressed);
    }
  }
  return enough;
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
  if (!m_aligned) {
    if (std::abs(bearing) > 0.45) return turn(bearing);
    if (d > world.touch() + 0.2) return acts::forwardSlow;
    if (d < world.touch() + 0.015) return acts::backwardSlow;
    return error > 0.0 ? acts::aroundRight : acts::aroundLeft;
  }
  if (std::abs(bearing) > m_numbers->kickBearing) {
    return world.ballInFront().y > 0.0 ? acts::sidleLeft : acts::sidleRight;
  }
  const bool ownWay = std::abs(world.localized() ? world.pose().yaw : world.imuYaw()) > 1.7;
  if (d < kicksFrom(world) && world.ballAge() < 0.3 && !ownWay) {
    return kick(world);
  }
  return d > world.touch() + m_numbers->slowWithin ? acts::forward : acts::forwardSlow;
}

/// With the foot on the ball's side; weakly where a strong kick would send the ball off the field.
Act Attack::kick(const WorldModel& world) {
  constexpr double alwaysStrong = 3.0;  // m: a ball that rolls no farther is kicked with all force
  const sim::BallAtFeet ball{world.ballDistance(), world.ballBearing()};
  const bool right = ball.bearing <= 0.0;
  const Act strong = right ? acts::kickRight : acts::kickLeft;
  const double range = kickRange(world, strong, ball);
  if (range <= alwaysStrong || !world.localized() ||
      staysIn(world, world.toField(world.ballInFront()), range)) {
    return strong;
  }
  return right ? acts::weakKickRight : acts::weakKickLeft;
}

Point aimFrom(const WorldModel& world, const Point& ball) {
  const sim::FieldSpec& field = world.field();
  const std::vector<Point> opponents = world.opponents();
  const double heading = world.localized() ? world.pose().yaw : world.imuYaw();
  Point best = world.opponentGoal();
  double least = 1e9;
  // A ball that lies on the goal line is not to come back from it.
  constexpr double close = 0.3;  // m
  const bool onTheLine =
      ball.x > field.halfLength() - close && std::abs(ball.y) < field.goalWidth / 2;
  const double depth = onTheLine ? 2 * close : 0.0;
  for (int i = -2; i <= 2; ++i) {
    const Point aim{field.halfLength() + depth, i * 0.16 * field.goalWidth};
    const double way = direction(ball, aim);
    double cost = 0.3 * std::abs(i) + std::abs(wrapToPi(way - heading));
    for (const Point& opponent : opponents) {
      const double d = distance(ball, opponent);
      const double off = std::abs(wrapToPi(direction(ball, opponent) - way));
      if (d > 0.3 && d < 2.0 && off < 0.5) cost += 2.0 * (0.5 - off);
    }
    if (cost < least) {
      least = cost;
      best = aim;
    }
  }
  return best;
}

bool mateIsFirst(const WorldModel& world, const Point& ball, double advantage) {
  const double own = distance(world.pose().position, ball) - advantage;
  for (const auto& mate : world.mates()) {
    if (!mate || !mate->active || mate->intention != Intention::Ball) continue;
    if (distance(mate->position, ball) < own) return true;
  }
  return false;
}

}  // namespace pitchboard::link
