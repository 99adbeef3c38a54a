// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/skills.h"

#include <array>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>

namespace pitchboard::link {
namespace {

using std::numbers::pi;

constexpr double planPeriod = 0.2;       // s: 5 Hz
constexpr double robotClearance = 0.12;  // m between two bodies
constexpr double postClearance = 0.06;
constexpr double ballClearance = 0.08;
// Of the distance to the ball, beyond that at which the body touches it (0.22 m for the published
// robot and ball):
constexpr double behindBall = 0.14;  // m, where an attack begins
constexpr double kickDistance = 0.025;
constexpr double kickBearing = 0.42;  // rad: the published kick's sector reaches 30 degrees

struct Gait {
  Act act;
  double direction;  // rad from the heading
};
constexpr std::array<Gait, 4> gaits{{{acts::forward, 0.0},
                                     {acts::sidleLeft, pi / 2},
                                     {acts::sidleRight, -pi / 2},
                                     {acts::backward, pi}}};

double speedOf(const WorldModel& world, const Act& act) {
  const sim::GaitSpeed speed = sim::gaitSpeed(world.body(), act.action, act.b);
  return repeatable::hypot(speed.forward, speed.left);
}

/// From where this robot's foot hits the ball surely, m between the centres.
double kicksFrom(const WorldModel& world) {
  constexpr double surely = 0.06;  // m inside the foot's reach
  const double near = world.touch() + kickDistance;
  if (world.body().kickLaw == sim::KickLaw::Published) return near;
  return std::max(near, world.body().kickReach - surely);
}

Act turn(double angle) {
  return angle > 0.0 ? acts::turnLeft : acts::turnRight;
}

}  // namespace

void Walk::plan(const WorldModel& world, const Goal& goal) {
  const sim::FieldSpec& field = world.field();
  m_obstacles.clear();
  const double body = 2 * field.robotRadius + robotClearance;
  for (const Point& mate : world.matePlaces()) m_obstacles.push_back({mate, body});
  for (const Point& opponent : world.opponents()) m_obstacles.push_back({opponent, body});
  for (const double x : {-field.halfLength(), field.halfLength()}) {
    for (const double y : {-field.goalWidth / 2, field.goalWidth / 2}) {
      m_obstacles.push_back({{x, y}, field.goalPostRadius + field.robotRadius + postClearance});
    }
  }
  if (goal.roundBall && world.seesBall()) {
    m_obstacles.push_back(
        {world.toField(world.ballInFront()), field.robotRadius + field.ballRadius + ballClearance});
  }
  m_path = m_planner.plan(world.pose().position, goal.pose.position, m_obstacles);
  m_planned = world.now();
  m_plannedFor = goal.pose.position;
}

std::optional<Act> Walk::step(const WorldModel& world, const Goal& goal) {
  const Pose& pose = world.pose();
  const double left = distance(pose.position, goal.pose.position);
  const double facing = wrapToPi(goal.pose.yaw - pose.yaw);
  if (left < goal.near) {
    m_gait = -1;
    if (std::abs(facing) < goal.facing) return std::nullopt;
    return turn(facing);
  }
  if (world.now() - m_planned >= planPeriod - 1e-9 ||
      distance(m_plannedFor, goal.pose.position) > 0.15) {
    plan(world, goal);
  }
  if (m_path.points.empty()) return acts::stop;
  m_stepped = world.now();
  while (m_path.points.size() > 2 && distance(m_path.next(), pose.position) < 0.08) {
    m_path.points.erase(m_path.points.begin());
  }
  const Point next = world.toLocal(m_path.next());
  const double bearing = direction({}, next);
  const double way = std::max(m_path.length, left);

  // The time each gait needs: turning into it, walking, turning to face what the goal asks.
  constexpr double keepGait = 0.8;  // s that another gait must be better by
  const double turnSpeed = sim::gaitSpeed(world.body(), acts::turnLeft.action, 0).turn;
  int best = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < gaits.size(); ++i) {
    const double before = wrapToPi(bearing - gaits[i].direction);
    const double after = wrapToPi(facing - before);
    double time =
        (std::abs(before) + std::abs(after)) / turnSpeed + way / speedOf(world, gaits[i].act);
    if (static_cast<int>(i) == m_gait) time -= keepGait;
    if (time < least) {
      least = time;
      best = static_cast<int>(i);
    }
  }
  if (best != m_gait) m_turning = true;
  m_gait = best;
  const Gait& gait = gaits[static_cast<std::size_t>(best)];
  const double off = wrapToPi(bearing - gait.direction);
  // Near the goal an angle matters less than it seems; far away it costs much.
  const double begin = left < 0.3 ? 0.6 : 0.35, end = 0.12;
  if (std::abs(off) > begin) m_turning = true;
  if (std::abs(off) < end) m_turning = false;
  return m_turning ? turn(off) : gait.act;
}

Act Search::step(const WorldModel& world, Walk& walk) {
  constexpr double headTime = 4.5;  // s: one sweep of the head
  constexpr double turnTime = 6.0;
  constexpr double placeTime = 22.0;
  if (!m_since) m_since = world.now();
  const double time = world.now() - *m_since;
  if (time < headTime) return acts::gait;
  if (time < headTime + turnTime || !world.localized()) return acts::turnRight;
  const double x = 0.28 * world.field().length, y = 0.22 * world.field().width;
  const std::array<Point, 5> places{{{0, 0}, {x, y}, {x, -y}, {-x, -y}, {-x, y}}};
  const auto i = static_cast<std::size_t>(std::max(0.0, time - headTime - turnTime) / placeTime) %
                 places.size();
  const auto act = walk.step(world, {{places[i], world.pose().yaw}, 0.4, pi, false});
  return act.value_or(acts::turnRight);
}

Act Attack::step(const WorldModel& world, Walk& walk, const Point& aim) {
  const Point local = world.ballInFront();
  const Point ball = world.toField(local);
  const double yaw = world.pose().yaw;
  // Without a pose the IMU still knows where the opponents' goal is.
  const double error =
      world.localized() ? wrapToPi(direction(ball, aim) - yaw) : wrapToPi(-world.imuYaw());
  const double d = world.ballDistance(), bearing = world.ballBearing();
  const double goalDistance = distance(ball, aim);
  const double opening = repeatable::atan2(0.35 * world.field().goalWidth, goalDistance);
  double tolerance = std::clamp(goalDistance > 3.0 ? 0.30 : opening, 0.12, 0.35);
  // An opponent at the ball leaves no time: forward is good enough.
  for (const Point& opponent : world.opponents()) {
    if (distance(opponent, ball) < 0.6) tolerance = std::max(tolerance, 0.7);
  }

  const double touch = world.touch();
  const bool enter = d < touch + 0.26 && std::abs(error) < 0.9 && std::abs(bearing) < 0.8;
  const bool stay = d < touch + 0.43 && std::abs(error) < 1.5 && std::abs(bearing) < 1.2;
  m_engaged = m_engaged ? stay : enter;
  if (m_engaged) return atBall(world, error, tolerance);
  m_aligned = false;

  const double kickYaw = yaw + error;
  const double back = touch + behindBall;
  const Point behind{ball.x - back * repeatable::cos(kickYaw),
                     ball.y - back * repeatable::sin(kickYaw)};
  const auto act = walk.step(world, {{behind, kickYaw}, 0.08, 0.5, true});
  return act.value_or(atBall(world, error, tolerance));
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
  if (std::abs(bearing) > kickBearing - 0.04) {
    return world.ballInFront().y > 0.0 ? acts::sidleLeft : acts::sidleRight;
  }
  const bool ownWay = std::abs(world.localized() ? world.pose().yaw : world.imuYaw()) > 1.7;
  if (d < kicksFrom(world) && world.ballAge() < 0.3 && !ownWay) {
    return bearing <= 0.0 ? acts::kickRight : acts::kickLeft;
  }
  return d > world.touch() + 0.12 ? acts::forward : acts::forwardSlow;
}

Point aimFrom(const WorldModel& world, const Point& ball) {
  const sim::FieldSpec& field = world.field();
  const std::vector<Point> opponents = world.opponents();
  const double heading = world.localized() ? world.pose().yaw : world.imuYaw();
  Point best = world.opponentGoal();
  double least = 1e9;
  for (int i = -2; i <= 2; ++i) {
    const Point aim{field.halfLength(), i * 0.16 * field.goalWidth};
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
