// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_collisions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <base/repeatable_math.h>
#include <simcore/world/gait_step.h>

namespace pitchboard::sim::rigid {
namespace {

constexpr double margin = 0.005;      // m, so that nearly touching things count as near
constexpr double partingSpeed = 0.5;  // m/s at which things dragged onto each other part

/// Whether a place is so far from a post or net along one axis that it is farther in all.
bool isBeside(const Obstacle& o, const Point& place, double distance) {
  return place.x - o.last.x >= distance || o.first.x - place.x >= distance ||
         place.y - o.last.y >= distance || o.first.y - place.y >= distance;
}

/// The direction from one round thing to another as they meet within `dt`, a unit vector. `apart`
/// leads from the one to the other, `moving` is the other's velocity as the one sees it.
std::optional<Point> meeting(const Point& apart, const Velocity& moving, double touching,
                             double dt) {
  const double towards = apart.x * moving.x + apart.y * moving.y;
  if (towards >= 0.0) return {};
  const double gap = apart.x * apart.x + apart.y * apart.y - touching * touching;
  double when = 0.0;
  if (gap > 0.0) {
    const double speed2 = moving.x * moving.x + moving.y * moving.y;
    const double root = towards * towards - speed2 * gap;
    if (root < 0.0) return {};
    when = (-towards - std::sqrt(root)) / speed2;
    if (when > dt) return {};
  }
  const Point there{apart.x + moving.x * when, apart.y + moving.y * when};
  const double away = length(there.x, there.y);
  return Point{there.x / away, there.y / away};
}

}  // namespace

void Collisions::updateRolling(double share, double dt) {
  if (m_share == share && m_dt == dt) return;
  m_share = share;
  m_dt = dt;
  m_rolling = rollingShare(share, dt);
}

std::size_t Collisions::addBody(const Tick& tick, std::size_t body) {
  std::size_t& slot = m_slots[body];
  if (slot == 0) {
    MovingBody moving;
    moving.body = body;
    if (body < tick.state.robots.size()) {
      moving.position = tick.state.robots[body].pose.position;
      moving.velocity = tick.motions[body].velocity;
      moving.reach = length(tick.motions[body].noise.x, tick.motions[body].noise.y);
    } else {
      moving.position = tick.state.ball.position;
      moving.velocity = m_ballVelocity;
    }
    moving.reach += length(moving.velocity.x, moving.velocity.y) * tick.dt;
    m_bodies.push_back(moving);
    slot = m_bodies.size();
  }
  return slot - 1;
}

void Collisions::findNeighbours(const Tick& tick) {
  const std::size_t robots = tick.state.robots.size();
  const FieldSpec& field = tick.settings().field;
  const Obstacles& obstacles = m_solver.obstacles();
  m_bodies.clear();
  m_pairs.clear();
  m_slots.assign(robots + 1, 0);
  m_x.resize(robots);
  m_y.resize(robots);
  m_radius.resize(robots);
  double farthest = 0.0;
  for (std::size_t i = 0; i < robots; ++i) {
    m_x[i] = tick.state.robots[i].pose.position.x;
    m_y[i] = tick.state.robots[i].pose.position.y;
    m_radius[i] = robotRadius(tick.world, i);
    const Velocity& v = tick.motions[i].velocity;
    const double pathX = std::abs(v.x) * tick.dt + std::abs(tick.motions[i].noise.x);
    const double pathY = std::abs(v.y) * tick.dt + std::abs(tick.motions[i].noise.y);
    farthest = std::max(farthest, pathX * pathX + pathY * pathY);
  }
  const double reach = std::sqrt(farthest);
  const Point& ball = tick.state.ball.position;
  const double ballReach = length(m_ballVelocity.x, m_ballVelocity.y) * tick.dt;

  const auto addObstacles = [&](std::size_t body, const Point& place, double radius, double path,
                                double restitution) {
    // Everything but the upper and lower wall stands at or behind the posts.
    const double extent = radius + path + margin;
    if (std::abs(place.x) + extent < field.halfLength() - field.goalPostRadius &&
        std::abs(place.y) + extent < field.halfWidth() + field.border) {
      return;
    }
    for (std::size_t k = 0; k < obstacleCount; ++k) {
      const double limit = obstacles[k].radius + radius;
      if (k >= wallCount && isBeside(obstacles[k], place, limit + path + margin)) continue;
      const double distance = clearance(obstacles, k, place).distance;
      if (distance >= limit + path + margin) continue;
      m_pairs.push_back(
          {addBody(tick, body), k, true, restitution, std::max(0.0, limit - distance)});
    }
  };
  for (std::size_t i = 0; i < robots; ++i) {
    addObstacles(i, {m_x[i], m_y[i]}, m_radius[i], reach, 0.0);
  }
  addObstacles(robots, ball, field.ballRadius, ballReach,
               tick.settings().rigidBody.postRestitution);

  const double largest = robots > 0 ? *std::ranges::max_element(m_radius) : 0.0;
  const double nearest = 2.0 * largest + 2.0 * reach + margin;
  const double near2 = nearest * nearest;
  for (std::size_t i = 1; i < robots; ++i) {
    const double x = m_x[i];
    const double y = m_y[i];
    int any = 0;  // counted without a branch first, so that the compiler can use vectors
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = m_x[j] - x;
      const double dy = m_y[j] - y;
      any += dx * dx + dy * dy < near2 ? 1 : 0;
    }
    for (std::size_t j = 0; any > 0 && j < i; ++j) {
      const double dx = m_x[j] - x;
      const double dy = m_y[j] - y;
      if (dx * dx + dy * dy > 1.001 * near2) continue;  // surely; roots cost more
      const double distance = length(dx, dy);
      const double touching = m_radius[i] + m_radius[j];
      if (distance >= touching + 2.0 * reach + margin) continue;
      const std::size_t first = addBody(tick, j);
      m_pairs.push_back({first, addBody(tick, i), false, 0.0, std::max(0.0, touching - distance)});
    }
  }

  for (std::size_t i = 0; i < robots; ++i) {
    const double ballTouching = m_radius[i] + field.ballRadius;
    const double ballNear = ballTouching + reach + ballReach + margin;
    const double dx = m_x[i] - ball.x;
    const double dy = m_y[i] - ball.y;
    if (dx * dx + dy * dy >= ballNear * ballNear) continue;
    const std::size_t first = addBody(tick, i);
    m_pairs.push_back({first, addBody(tick, robots), false,
                       tick.settings().rigidBody.robotRestitution,
                       std::max(0.0, ballTouching - length(dx, dy))});
  }
}

/// What robots fall by: the momentum that each two exchange when they meet, the same for both, as
/// if nobody else touched them. Box2D's own impulses are no measure of it: whether it sees a
/// contact that separate() has resolved depends on its rounding.
void Collisions::addPushes(Tick& tick) const {
  const std::size_t ball = tick.state.robots.size();
  const auto massOf = [&](std::size_t body) {
    return body == ball ? tick.settings().rigidBody.ballMass : tick.model(body).mass;
  };
  const auto radiusOf = [&](std::size_t body) {
    return body == ball ? tick.settings().field.ballRadius : m_radius[body];
  };
  const auto push = [&](std::size_t body, const Point& direction, double impulse, double share) {
    if (body == ball) return;
    Motion& motion = tick.motions[body];
    motion.push.x += direction.x * impulse * share;
    motion.push.y += direction.y * impulse * share;
    motion.stopped.x += direction.x * impulse / massOf(body);
    motion.stopped.y += direction.y * impulse / massOf(body);
  };
  for (const NearPair& pair : m_pairs) {
    const MovingBody& one = m_bodies[pair.first];
    if (pair.obstacle) {
      const Obstacle& obstacle = m_solver.obstacles()[pair.second];
      const Clearance clear = clearance(m_solver.obstacles(), pair.second, one.position);
      const double gap = clear.distance - obstacle.radius - radiusOf(one.body);
      const double into =
          -(one.velocity.x * clear.direction.x + one.velocity.y * clear.direction.y);
      if (into <= 0.0 || gap > into * tick.dt) continue;
      push(one.body, clear.direction, massOf(one.body) * into, tippingShare);
      continue;
    }
    const MovingBody& other = m_bodies[pair.second];
    const Velocity moving{other.velocity.x - one.velocity.x, other.velocity.y - one.velocity.y};
    const auto path =
        meeting({other.position.x - one.position.x, other.position.y - one.position.y}, moving,
                radiusOf(one.body) + radiusOf(other.body), tick.dt);
    if (!path) continue;
    const double into = -(moving.x * path->x + moving.y * path->y);
    const double mass =
        massOf(one.body) * massOf(other.body) / (massOf(one.body) + massOf(other.body));
    const double impulse = mass * into * (into > bouncesFrom ? 1.0 + pair.restitution : 1.0);
    const double share = other.body == ball ? 1.0 : tippingShare;
    push(one.body, {-path->x, -path->y}, impulse, share);
    push(other.body, *path, impulse, share);
  }
}

void Collisions::separate(const Tick& tick) {
  const std::size_t ball = tick.state.robots.size();
  const double parting = partingSpeed * tick.dt;
  for (NearPair& pair : m_pairs) pair.overlap = std::max(0.0, pair.overlap - parting);
  m_radii.clear();
  for (const MovingBody& moving : m_bodies) {
    const double ballRadius = tick.settings().field.ballRadius;
    m_radii.push_back(moving.body == ball ? ballRadius : m_radius[moving.body]);
  }
  m_separation.separate(m_bodies, m_radii, m_pairs, m_solver.obstacles(), ball);
}

void Collisions::writeBack(Tick& tick) {
  const std::size_t ball = tick.state.robots.size();
  for (const MovingBody& moving : m_bodies) {
    if (moving.body == ball) {
      tick.state.ball.position = moving.position;
      m_ballVelocity = moving.velocity;
      continue;
    }
    RigidRobot& robot = tick.state.robots[moving.body];
    Motion& motion = tick.motions[moving.body];
    // With falls, what it runs into stops its gait even when Box2D has not seen it.
    const bool stopped = motion.stopped.x != 0.0 || motion.stopped.y != 0.0;
    if (moving.deflected || stopped) {
      const double c = motion.heading.cos();
      const double s = motion.heading.sin();
      const double dvx =
          moving.deflected ? moving.velocity.x - motion.velocity.x : motion.stopped.x;
      const double dvy =
          moving.deflected ? moving.velocity.y - motion.velocity.y : motion.stopped.y;
      const double grip = feetGrip * tick.dt;
      robot.forwardSpeed = afterContact(robot.forwardSpeed, c * dvx + s * dvy, grip);
      robot.sidewaysSpeed = afterContact(robot.sidewaysSpeed, c * dvy - s * dvx, grip);
    }
    robot.velocity = {(moving.position.x - robot.pose.position.x) / tick.dt,
                      (moving.position.y - robot.pose.position.y) / tick.dt};
    robot.pose.position = moving.position;
  }
}

void Collisions::advance(Tick& tick) {
  const SimulationSettings& settings = tick.settings();
  const std::size_t robots = tick.state.robots.size();
  m_solver.prepare(tick.world);
  if (m_bodies.capacity() <= robots) {
    m_bodies.reserve(robots + 1);
    m_radii.reserve(robots + 1);
    m_pairs.reserve(maxPairs(robots));
    m_separation.reserve(robots + 1, maxPairs(robots));
  }
  const Surface& surface = settings.field.surface;
  updateRolling(surface.keptPerFrame, tick.dt);

  RigidBall& ball = tick.state.ball;
  const double ballSpeed = length(ball.velocity.x, ball.velocity.y);
  const auto [mean, left] = rolledOf(surface, m_rolling, ballSpeed, tick.dt);
  m_ballVelocity = {ball.velocity.x * mean, ball.velocity.y * mean};
  tick.ball = {
      ball.position,
      {ball.position.x + m_ballVelocity.x * tick.dt, ball.position.y + m_ballVelocity.y * tick.dt}};
  findNeighbours(tick);
  if (!m_pairs.empty()) {
    if (settings.rigidBody.falls) addPushes(tick);
    m_solver.solve(m_bodies, m_pairs, tick.dt);
    // Noise is no push: it displaces the robot as far as there is room.
    for (MovingBody& moving : m_bodies) {
      if (moving.body == robots) continue;
      moving.position.x += tick.motions[moving.body].noise.x;
      moving.position.y += tick.motions[moving.body].noise.y;
    }
    separate(tick);
    writeBack(tick);
  }
  for (std::size_t i = 0; i < robots; ++i) {
    if (m_slots[i] != 0) continue;
    RigidRobot& robot = tick.state.robots[i];
    const Motion& motion = tick.motions[i];
    const double dx = motion.velocity.x * tick.dt + motion.noise.x;
    const double dy = motion.velocity.y * tick.dt + motion.noise.y;
    robot.pose.position.x += dx;
    robot.pose.position.y += dy;
    robot.velocity = {dx / tick.dt, dy / tick.dt};
  }
  if (m_slots[robots] == 0) {
    ball.position.x += m_ballVelocity.x * tick.dt;
    ball.position.y += m_ballVelocity.y * tick.dt;
  }
  // The mean speed says the speed at the end; a ball that keeps nothing stands still.
  const double end = mean > 0.0 ? left / mean : 0.0;
  ball.velocity = {m_ballVelocity.x * end, m_ballVelocity.y * end};
}

}  // namespace pitchboard::sim::rigid
