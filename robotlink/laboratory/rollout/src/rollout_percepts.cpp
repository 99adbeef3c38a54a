// SPDX-License-Identifier: GPL-3.0-or-later
// What the robots of a rollout believe of themselves, see, and tell each other.
#include "rollout_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <base/angles.h>
#include <base/random.h>
#include <base/repeatable_math.h>

namespace pitchboard::rollout {
namespace {

constexpr double pointingTolerance = std::numbers::pi / 180.0;

}  // namespace

void RolloutWorld::drift(std::size_t i, RandomBatch::Sequence& random) {
  Body& body = m_bodies[i];
  const BeliefNoise& noise = of(i).belief;
  body.error.x = noise.place.step(body.error.x, cycleTime, body.inMotion, random.normal(0.0, 1.0));
  body.error.y = noise.place.step(body.error.y, cycleTime, body.inMotion, random.normal(0.0, 1.0));
  body.yawError = noise.yaw.step(body.yawError, cycleTime, body.inMotion, random.normal(0.0, 1.0));
  body.sigma += noise.place.gain * cycleTime * (noise.place.filterSigma - body.sigma);
}

Pose RolloutWorld::believed(std::size_t i) const {
  const Body& body = m_bodies[i];
  return {{body.pose.position.x + body.error.x, body.pose.position.y + body.error.y},
          wrapToPi(body.pose.yaw + body.yawError)};
}

void RolloutWorld::searchWithHead(std::size_t i) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  const double step = model.headSpeed * cycleTime;
  body.head += body.panRight ? -step : step;
  if (std::abs(body.head) < model.panLimit) return;
  body.head = std::clamp(body.head, -model.panLimit, model.panLimit);
  body.panRight = body.head > 0.0;
}

void RolloutWorld::look(std::size_t i, RandomBatch::Sequence& random) {
  Body& body = m_bodies[i];
  m_input.ball.reset();
  if (body.looksForOpponents) m_input.robots = {};
  if (body.isDown()) return;
  if (body.search) searchWithHead(i);
  const Seen image = bodySeen(of(i).delayTicks, i);
  const double ahead = of(i).model->cameraForward;
  const Point lens{image.pose.position.x + ahead * image.cos,
                   image.pose.position.y + ahead * image.sin};
  if (body.looksForOpponents) {
    lookAtOpponents(i, image, lens);
  } else {
    lookAtBall(i, image, lens, random);
  }
}

void RolloutWorld::lookAtBall(std::size_t i, const Seen& image, const Point& lens,
                              RandomBatch::Sequence& random) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  const sim::NoiseParameters& noise = of(i).noise;
  const Point ball = ballSeen(of(i).delayTicks);
  double dx = ball.x - lens.x, dy = ball.y - lens.y;
  if (dx * dx + dy * dy >= model.visionRange * model.visionRange) return;
  double bearing = wrapToPi(repeatable::atan2(dy, dx) - image.pose.yaw);
  if (std::abs(wrapToPi(bearing - image.head)) >= model.fieldOfView / 2.0) return;
  if (random.uniform() < noise.missedDetection) return;
  double away = approached(dx, dy);
  if (model.fromCamera) {
    away = approached(away, model.cameraHeight - field().ballRadius);
  } else if (model.cameraForward != 0.0) {
    dx = ball.x - image.pose.position.x;
    dy = ball.y - image.pose.position.y;
    away = approached(dx, dy);
    bearing = wrapToPi(repeatable::atan2(dy, dx) - image.pose.yaw);
  }
  away = std::max(0.0, random.normal(away, noise.visionDistance * away));
  bearing = wrapToPi(random.normal(bearing, noise.visionBearing));
  const double goal = std::clamp(bearing, -model.panLimit, model.panLimit);
  const double step = model.headSpeed * cycleTime;
  body.panRight = goal < body.head;
  body.head += std::clamp(goal - body.head, -step, step);
  if (std::abs(goal - body.head) <= pointingTolerance) body.search = false;
  if (away > 0.0) m_input.ball = link::SeenAt{away, bearing};
}

void RolloutWorld::lookAtOpponents(std::size_t i, const Seen& image, const Point& lens) {
  const sim::RobotModel& model = *of(i).model;
  const sim::NoiseParameters& noise = of(i).noise;
  CounterRandom random(m_seed, static_cast<int>(i) + 1, NoiseStream::RobotVision, m_cycle);
  for (const std::size_t other : m_here) {
    if (sideOf(other) == sideOf(i)) continue;
    const Point& place = bodyAt(static_cast<std::size_t>(of(i).delayTicks), other).pose.position;
    const double dx = place.x - lens.x, dy = place.y - lens.y;
    if (dx * dx + dy * dy >= model.visionRange * model.visionRange) continue;
    const double bearing = wrapToPi(repeatable::atan2(dy, dx) - image.pose.yaw);
    if (std::abs(wrapToPi(bearing - image.head)) >= model.fieldOfView / 2.0) continue;
    // Some frame of the cycle shows it, so that none is missed.
    const Point from = image.pose.position;
    const double away = random.normal(distance(from, place), noise.robotDistance);
    const double seen =
        random.normal(wrapToPi(direction(from, place) - image.pose.yaw), noise.robotBearing);
    if (away > 0.0) m_input.robots[other] = link::SeenAt{away, wrapToPi(seen)};
  }
}

void RolloutWorld::talk() {
  for (const std::size_t i : m_here) m_received[i] = m_sent[i];
}

/// All team-mates; of many those who go for the ball, then those who see it, then the nearest.
void RolloutWorld::listen(std::size_t i) {
  m_input.matePlaces.clear();
  InlineVector<std::size_t, most> mates;
  for (const std::size_t other : m_here) {
    if (other == i || sideOf(other) != sideOf(i)) continue;
    mates.push_back(other);
    m_input.matePlaces.push_back(m_received[other].place);
  }
  if (mates.size() > link::maxTeamMates) {
    const auto rank = [&](std::size_t mate) {
      const TeamReport& report = m_received[mate];
      return std::tuple(report.intention == link::Intention::Ball ? 0 : 1, report.ball ? 0 : 1,
                        distance(report.place, m_input.believed.position), mate);
    };
    std::sort(mates.begin(), mates.end(),
              [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    mates.shrink(link::maxTeamMates);
    std::sort(mates.begin(), mates.end());
  }
  for (std::size_t k = 0; k < m_input.mates.size(); ++k) {
    m_input.mates[k].reset();
    if (k >= mates.size()) continue;
    const TeamReport& report = m_received[mates[k]];
    m_input.mates[k] = link::TeamMate{report.place, report.intention, report.upright, report.ball};
  }
}

void RolloutWorld::remember() {
  const std::size_t at = m_tick % m_constants->moments;
  m_pastBalls[at] = m_ball;
  const std::size_t players = m_constants->players.size();
  for (const std::size_t i : m_here) {
    const Body& body = m_bodies[i];
    m_pastBodies[at * players + i] = {body.pose, body.cos, body.sin, body.head};
  }
}

const Point& RolloutWorld::ballAt(std::size_t ticksAgo) const {
  const std::size_t moments = m_constants->moments;
  return m_pastBalls[(m_tick + moments - ticksAgo) % moments];
}

const RolloutWorld::Seen& RolloutWorld::bodyAt(std::size_t ticksAgo, std::size_t i) const {
  const std::size_t moments = m_constants->moments;
  return m_pastBodies[(m_tick + moments - ticksAgo) % moments * m_constants->players.size() + i];
}

Point RolloutWorld::ballSeen(double ticksAgo) const {
  const auto whole = static_cast<std::size_t>(ticksAgo);
  const double part = ticksAgo - static_cast<double>(whole);
  const Point &late = ballAt(whole), &early = ballAt(whole + (part > 0.0 ? 1 : 0));
  return {late.x + part * (early.x - late.x), late.y + part * (early.y - late.y)};
}

RolloutWorld::Seen RolloutWorld::bodySeen(double ticksAgo, std::size_t i) const {
  const auto whole = static_cast<std::size_t>(ticksAgo);
  const double part = ticksAgo - static_cast<double>(whole);
  Seen seen = bodyAt(whole, i);
  if (part <= 0.0) return seen;
  const Seen& early = bodyAt(whole + 1, i);
  seen.pose.position.x += part * (early.pose.position.x - seen.pose.position.x);
  seen.pose.position.y += part * (early.pose.position.y - seen.pose.position.y);
  seen.pose.yaw = wrapToPi(seen.pose.yaw + part * wrapToPi(early.pose.yaw - seen.pose.yaw));
  seen.head += part * (early.head - seen.head);
  return seen;
}

}  // namespace pitchboard::rollout
