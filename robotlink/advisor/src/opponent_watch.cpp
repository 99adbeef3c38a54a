// SPDX-License-Identifier: GPL-3.0-or-later
#include "opponent_watch.h"

#include <algorithm>
#include <cmath>

#include <robotlink/cognition/act.h>

namespace pitchboard::link {
namespace {

constexpr double sightingSigma = 0.12;  // m, as of the belief

Point theirs(const Point& ours) {
  return {-ours.x, -ours.y};
}

}  // namespace

void OpponentWatch::update(const Situation& now, double time, const sim::FieldSpec& field,
                           const sim::RobotModel& model, OpponentModel& learned) {
  // The blackboard keeps a place until it is forgotten: what has not changed was not seen again.
  m_fresh.clear();
  for (const Point& place : now.opponents) {
    if (std::ranges::find(m_before, place) == m_before.end()) m_fresh.push_back(place);
  }
  m_before = now.opponents;
  if (now.referee != Referee::Play || !now.localized) {
    m_walks.clear();
    m_roll.reset();
    return;
  }
  watchKeeper(now, time, field, learned);
  watchWalks(time, model, learned);
  watchBall(now, time, field, learned);
}

/// The opponent that is nearest to its goal. Two looks soon after each other say hardly more than
/// one.
void OpponentWatch::watchKeeper(const Situation& now, double time, const sim::FieldSpec& field,
                                OpponentModel& learned) {
  constexpr double pause = 2.0;     // s
  constexpr double room = 1.3;      // m before a goal
  constexpr double comesOut = 1.6;  // m: of a ball that is closer the keeper takes care
  if (time < m_keeperSeen) m_keeperSeen = -1e9;  // the clock was put back
  if (!now.ball || time < m_keeperSeen + pause) return;
  const Point goal{field.halfLength(), 0.0};
  if (distance(*now.ball, goal) < comesOut) return;
  const Point* keeper = nullptr;
  for (const Point& place : m_fresh) {
    if (distance(place, goal) > room) continue;
    if (!keeper || distance(place, goal) < distance(*keeper, goal)) keeper = &place;
  }
  if (!keeper) return;
  m_keeperSeen = time;
  learnKeeper(learned, field, theirs(*keeper), theirs(*now.ball));
}

/// How far one comes in a few seconds. Each sighting continues the walk that it fits best.
void OpponentWatch::watchWalks(double time, const sim::RobotModel& model, OpponentModel& learned) {
  constexpr double window = 4.0, forgotten = 3.0;  // s
  constexpr double jump = 0.25, fastest = 0.35;    // m, and m/s more
  const double full = sim::gaitSpeed(model, acts::forward.action, acts::forward.b).forward;
  for (const Point& place : m_fresh) {
    Walk* best = nullptr;
    for (Walk& walk : m_walks) {
      const double metres = distance(walk.last, place);
      if (walk.seen >= time || metres > jump + fastest * (time - walk.seen)) continue;
      if (!best || metres < distance(best->last, place)) best = &walk;
    }
    if (!best) {
      m_walks.push_back({place, place, time, time});
      continue;
    }
    best->last = place;
    best->seen = time;
    const double took = time - best->since;
    if (took < window || full <= 0.0) continue;
    const double unit = took * full;
    learnPace(learned, distance(best->from, place) / unit, std::sqrt(2.0) * sightingSigma / unit);
    best->from = place;
    best->since = time;
  }
  std::erase_if(
      m_walks, [&](const Walk& walk) { return time - walk.seen > forgotten || walk.since > time; });
}

/// Kicks: a ball that has rolled far a moment after nobody of the own team was at it. An opponent
/// at the ball is seen too seldom to ask for one.
void OpponentWatch::watchBall(const Situation& now, double time, const sim::FieldSpec& field,
                              OpponentModel& learned) {
  constexpr double ours = 0.55;                    // m
  constexpr double leastRoll = 0.8, rests = 0.25;  // m that it rolls; that it may seem to roll
  constexpr double jump = 0.6;                     // m: put there by the referee
  constexpr double waits = 0.8, longest = 2.0;     // s
  if (!now.seesBall || !now.ball) return;
  const Point ball = *now.ball;
  const auto isNear = [&ball](double within) {
    return [&ball, within](const Point& place) { return distance(place, ball) < within; };
  };
  bool isOurs = isNear(ours)(now.pose.position);
  for (const auto& mate : now.mates) isOurs = isOurs || (mate && isNear(ours)(mate->position));
  if (m_roll) {
    Roll& roll = *m_roll;
    const double age = time - roll.since;
    const bool lost = time < roll.seen || time - roll.seen > 0.5 || age > longest ||
                      distance(roll.last, ball) > jump || isOurs;
    roll.last = ball;
    roll.seen = time;
    if (!lost && distance(roll.from, ball) >= leastRoll) {
      learnAim(learned, field, theirs(roll.from), theirs(ball));
      m_roll.reset();
      return;
    }
    if (lost || (age > waits && distance(roll.from, ball) < rests)) m_roll.reset();
  }
  if (!m_roll && !isOurs) m_roll = Roll{ball, ball, time, time};
}

}  // namespace pitchboard::link
