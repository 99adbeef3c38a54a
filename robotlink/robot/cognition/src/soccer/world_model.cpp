// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/world_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>

namespace pitchboard::link {
namespace {

constexpr unsigned cyclesBetweenLooks = 8;  // one of them for opponents
constexpr double ballGain = 0.45;           // of a new sighting against the prediction
constexpr double ballJump = 0.5;            // m: farther from the prediction it has been kicked

}  // namespace

void WorldModel::update(const SoccerInput& input, double now) {
  const double seconds = m_first ? 0.0 : std::clamp(now - m_now, 0.0, 1.0);
  m_now = now;
  m_first = false;
  m_referee = input.referee;
  m_fallen = input.fallen;
  m_setPlay = input.setPlay;
  m_setPlayOurs = input.setPlayIsOurs;

  m_imuYaw = input.imuYaw;
  m_sigma = input.sigma;
  findSide(input.believed.yaw);
  m_pose = m_attacksLeft ? Pose{toStudio(input.believed.position),
                                wrapToPi(input.believed.yaw + std::numbers::pi)}
                         : input.believed;
  moveWithBody(input.doing, seconds);
  if (m_looksForOpponents) {
    seeRobots(input);
  } else if (input.ball) {
    seeBall(*input.ball);
  }
  m_opponentPlaces.clear();
  for (const Sighting& sighting : m_opponents) {
    if (m_now - sighting.time < m_opponentMemory) m_opponentPlaces.push_back(sighting.position);
  }
  readMates(input);
  m_keeperShift = input.keeperShift;
  m_looksForOpponents = ++m_cycle % cyclesBetweenLooks == 0;
}

void WorldModel::findSide(double theta) {
  if (m_facesLeft) {
    m_attacksLeft = *m_facesLeft;
    return;
  }
  if (!localized()) return;
  constexpr double rate = 0.05, sure = 0.3;
  m_side += rate * (repeatable::cos(theta - m_imuYaw) - m_side);
  if (std::abs(m_side) > sure) m_attacksLeft = m_side < 0.0;
}

void WorldModel::moveWithBody(const Act& doing, double seconds) {
  const sim::GaitSpeed speed = sim::gaitSpeed(m_body, doing.action, doing.b);
  const double x = m_ballLocal.x - speed.forward * seconds;
  const double y = m_ballLocal.y - speed.left * seconds;
  const auto [s, c] = repeatable::sinCos(speed.turn * seconds);
  m_ballLocal = {c * x + s * y, c * y - s * x};
}

void WorldModel::seeBall(const SeenAt& ball) {
  const auto [s, c] = repeatable::sinCos(ball.bearing);
  const Point seen{ball.distance * c, ball.distance * s};
  const Point change{seen.x - m_ballLocal.x, seen.y - m_ballLocal.y};
  const bool jump = length(change) > ballJump || !seesBall();
  const double gain = jump ? 1.0 : ballGain;
  m_ballLocal = {m_ballLocal.x + gain * change.x, m_ballLocal.y + gain * change.y};
  m_ballSeen = m_now;
  m_ballField = toField(m_ballLocal);
  if (localized()) m_track.see(toField(seen), ball.distance, m_now);
}

void WorldModel::seeRobots(const SoccerInput& input) {
  for (std::size_t i = 0; i < m_opponents.size(); ++i) {
    if (!input.robots[i]) continue;
    const auto [s, c] = repeatable::sinCos(input.robots[i]->bearing);
    const double distance = input.robots[i]->distance;
    m_opponents[i] = {toField({distance * c, distance * s}), m_now};
  }
}

void WorldModel::readMates(const SoccerInput& input) {
  m_mates = input.mates;
  for (auto& mate : m_mates) {
    if (!mate) continue;
    mate->position = toStudio(mate->position);
    if (mate->ball) mate->ball = toStudio(*mate->ball);
  }
  m_matePlaces.clear();
  for (const Point& place : input.matePlaces) m_matePlaces.push_back(toStudio(place));
}

double WorldModel::ballDistance() const {
  return length(m_ballLocal);
}
double WorldModel::ballBearing() const {
  return direction({}, m_ballLocal);
}

std::optional<Point> WorldModel::ball() const {
  if (seesBall()) return toField(m_ballLocal);
  // The nearest team-mate that sees it knows best.
  std::optional<Point> reported;
  double nearest = 1e9;
  for (const auto& mate : m_mates) {
    if (!mate || !mate->ball) continue;
    const double d = distance(*mate->ball, mate->position);
    if (d < nearest) {
      nearest = d;
      reported = mate->ball;
    }
  }
  if (reported) return reported;
  if (ballAge() < m_ballMemory) return m_ballField;
  return std::nullopt;
}

std::optional<Point> WorldModel::ballStops() const {
  if (!seesBall() || !localized()) return ball();
  return m_track.stopsAt(toField(m_ballLocal), m_field, m_now);
}

Pose WorldModel::toStudio(const Pose& turned) const {
  return {toStudio(turned.position),
          m_attacksLeft ? wrapToPi(turned.yaw + std::numbers::pi) : turned.yaw};
}

Point WorldModel::toField(const Point& p) const {
  const auto [s, c] = repeatable::sinCos(m_pose.yaw);
  return {m_pose.position.x + c * p.x - s * p.y, m_pose.position.y + s * p.x + c * p.y};
}

}  // namespace pitchboard::link
