// SPDX-License-Identifier: GPL-3.0-or-later
#include "planning/walk.h"

#include <array>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>

namespace pitchboard::link {
namespace {

using std::numbers::pi;

constexpr double robotClearance = 0.12;  // m between two bodies
constexpr double roomyClearance = 0.30;  // of who has time
constexpr double postClearance = 0.06;
constexpr double ballClearance = 0.08;

struct Gait {
  Act act;
  double direction;  // rad from the heading
};
constexpr std::array<Gait, 4> gaits{{{acts::forward, 0.0},
                                     {acts::sidleLeft, pi / 2},
                                     {acts::sidleRight, -pi / 2},
                                     {acts::backward, pi}}};

double speedOf(const sim::RobotModel& body, const Act& act) {
  const sim::GaitSpeed speed = sim::gaitSpeed(body, act.action, act.b);
  return repeatable::hypot(speed.forward, speed.left);
}

}  // namespace

void Walk::plan(const Surroundings& world, const Target& target) {
  // Robots, posts and the ball.
  InlineVector<Obstacle, Points::capacity + 5> obstacles;
  const double bodies =
      m_field.robotRadius + m_othersRadius + (target.apart ? roomyClearance : robotClearance);
  for (const Point& robot : world.robots) obstacles.push_back({robot, bodies});
  for (const double x : {-m_field.halfLength(), m_field.halfLength()}) {
    for (const double y : {-m_field.goalWidth / 2, m_field.goalWidth / 2}) {
      obstacles.push_back({{x, y}, m_field.goalPostRadius + m_field.robotRadius + postClearance});
    }
  }
  if (target.ball) {
    obstacles.push_back({*target.ball, m_field.robotRadius + m_field.ballRadius + ballClearance});
  }
  m_path = m_planner.plan(world.pose.position, target.pose.position, obstacles);
  m_planned = world.now;
  m_plannedFor = target.pose.position;
}

std::optional<Act> Walk::step(const Surroundings& world, const Target& target) {
  const double left = distance(world.pose.position, target.pose.position);
  if (left < target.near) {
    rest();
    const double facing = wrapToPi(target.pose.yaw - world.pose.yaw);
    if (std::abs(facing) < target.facing) return std::nullopt;
    return acts::turn(facing);
  }
  if (m_path.points.empty() || world.now - m_planned >= m_planPeriod - 1e-9 ||
      distance(m_plannedFor, target.pose.position) > 0.15) {
    plan(world, target);
  }
  if (m_path.points.empty()) return acts::stop;
  while (m_path.points.size() > 2 && distance(m_path.next(), world.pose.position) < 0.08) {
    m_path.points.erase(m_path.points.begin());
  }
  return gaitTowards(world, target, left);
}

Act Walk::gaitTowards(const Surroundings& world, const Target& target, double left) {
  const double bearing = wrapToPi(direction(world.pose.position, m_path.next()) - world.pose.yaw);
  const double facing = wrapToPi(target.pose.yaw - world.pose.yaw);
  const double pathLength = std::max(m_path.length, left);

  // The time each gait needs: turning into it, walking, turning to face what the target asks.
  constexpr double keepGait = 0.8;  // s that another gait must be better by
  const double turnSpeed = sim::gaitSpeed(m_body, acts::turnLeft.action, 0).turn;
  int best = 0;
  double least = 1e9;
  constexpr double longWalk = 0.5;  // m
  const std::size_t allowed = target.forwards && left > longWalk ? 1 : gaits.size();
  for (std::size_t i = 0; i < allowed; ++i) {
    const double before = wrapToPi(bearing - gaits[i].direction);
    const double after = wrapToPi(facing - before);
    double time = (std::abs(before) + std::abs(after)) / turnSpeed +
                  pathLength / speedOf(m_body, gaits[i].act);
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
  // Near the target an angle matters less than it seems; far away it costs much.
  const double begin = left < 0.3 ? 0.6 : 0.35, end = 0.12;
  if (std::abs(off) > begin) m_turning = true;
  if (std::abs(off) < end) m_turning = false;
  return m_turning ? acts::turn(off) : gait.act;
}

void Walk::rest() {
  m_path = {};
  m_gait = -1;
  m_turning = false;
}

}  // namespace pitchboard::link
