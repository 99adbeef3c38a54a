// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_separation.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::sim::rigid {
namespace {

constexpr int rounds = 40;
constexpr int roundsForBallAlone = 10;  // after these robots give way to a ball that is stuck
constexpr double tolerance = 1e-5;      // m
constexpr double rounding = 1e-12;      // m, more than that of any sum here

bool pushObstacle(const Separation::Pair& pair, const Obstacles& obstacles, Point& place) {
  const Clearance gap = clearance(obstacles, pair.second, place);
  const double push = pair.touching - gap.distance;
  if (push - pair.overlap <= tolerance) return false;
  place.x += gap.direction.x * (push - pair.overlap);
  place.y += gap.direction.y * (push - pair.overlap);
  return true;
}

inline bool push(const Separation::Pair& pair, Point& a, Point& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double distance2 = dx * dx + dy * dy;
  if (distance2 >= pair.far2) return false;
  const double distance = std::sqrt(distance2);
  const double push = pair.touching - distance - pair.overlap;
  if (push <= tolerance) return false;
  // Exactly on each other: part along x, whichever came first to the left.
  const double nx = distance > 0.0 ? dx / distance : 1.0;
  const double ny = distance > 0.0 ? dy / distance : 0.0;
  const double pathX = nx * push, pathY = ny * push;
  a.x -= pathX * pair.firstsShare;
  a.y -= pathY * pair.firstsShare;
  b.x += pathX * pair.secondsShare;
  b.y += pathY * pair.secondsShare;
  return true;
}

}  // namespace

Separation::Pair Separation::pairOf(const NearPair& pair, std::span<const MovingBody> bodies,
                                    std::span<const double> radius, const Obstacles& obstacles,
                                    std::size_t ball) const {
  Pair out;
  out.first = static_cast<std::uint32_t>(pair.first);
  out.second = static_cast<std::uint32_t>(pair.second);
  out.obstacle = pair.obstacle;
  const double other = pair.obstacle ? obstacles[pair.second].radius : radius[pair.second];
  out.touching = pair.obstacle ? other + radius[pair.first] : radius[pair.first] + other;
  out.overlap = pair.overlap;
  const double far = std::max(0.0, out.touching - out.overlap - tolerance) + rounding;
  out.far2 = far * far;
  const bool ballAlone = !pair.obstacle && bodies[pair.second].body == ball;
  out.secondsShare = ballAlone ? 1.0 : 0.5;
  out.firstsShare = 1.0 - out.secondsShare;
  return out;
}

/// By turns: one after the last turn of either body.
void Separation::order(std::span<const Pair> pairs) {
  m_turns.assign(m_places.size(), 0);
  m_turn.resize(pairs.size());
  m_begins.assign(pairs.size() + 1, 0);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Pair& pair = pairs[k];
    std::uint32_t turn = m_turns[pair.first];
    if (!pair.obstacle) {
      turn = std::max(turn, m_turns[pair.second]);
      m_turns[pair.second] = turn + 1;
    }
    m_turns[pair.first] = turn + 1;
    m_turn[k] = turn;
    ++m_begins[turn + 1];
  }
  for (std::size_t turn = 1; turn < m_begins.size(); ++turn) m_begins[turn] += m_begins[turn - 1];
  m_ordered.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) m_ordered[m_begins[m_turn[k]]++] = pairs[k];
}

void Separation::separate(std::span<MovingBody> bodies, std::span<const double> radius,
                          std::span<const NearPair> pairs, const Obstacles& obstacles,
                          std::size_t ball) {
  m_places.clear();
  for (const MovingBody& moving : bodies) m_places.push_back(moving.position);
  m_given.clear();
  for (const NearPair& pair : pairs) {
    m_given.push_back(pairOf(pair, bodies, radius, obstacles, ball));
  }
  std::span<Pair> all = m_given;
  Point* const places = m_places.data();
  bool apart = false;
  for (int round = 0; round < rounds && !apart; ++round) {
    if (round == 1) {
      order(m_given);
      all = m_ordered;
    }
    if (round == roundsForBallAlone) {
      for (Pair& pair : all) pair.firstsShare = pair.secondsShare = 0.5;
    }
    apart = true;
    for (const Pair& pair : all) {
      Point& first = places[pair.first];
      const bool pushed = pair.obstacle ? pushObstacle(pair, obstacles, first)
                                        : push(pair, first, places[pair.second]);
      if (pushed) apart = false;
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].position = m_places[i];
}

}  // namespace pitchboard::sim::rigid
