// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/behaviour.h"

#include <cmath>

#include <base/angles.h>
#include <base/repeatable_math.h>

namespace pitchboard::link {
Choice Behaviour::choose(const WorldModel& world) {
  if (world.fallen()) return {acts::stop, Intention::None, {}, false};  // control gets it up
  switch (world.referee()) {
    case Referee::Play:
      return play(world);
    case Referee::Ready:
      if (world.localized()) {
        Choice choice = walkTo(world, kickOff(world), Intention::Walk);
        choice.search = true;
        return choice;
      }
      break;
    case Referee::Silent:
    case Referee::Stop:
    case Referee::Set:
      break;
  }
  m_search.restart();
  // Standing, it still looks where the ball is.
  return {acts::stop, Intention::Idle, {}, true};
}

Choice Behaviour::walkTo(const WorldModel& world, const Pose& pose, Intention intention,
                         double near) {
  const auto act = m_walk.step(world, {pose, near, 0.35, true});
  return {act.value_or(acts::stop), intention, pose.position, !world.seesBall()};
}

Choice Behaviour::lookForBall(const WorldModel& world) {
  return {m_search.step(world, m_walk), Intention::Search, {}, true};
}

Choice Behaviour::toBall(const WorldModel& world, const Point& ball) {
  if (world.seesBall()) {
    m_told = world.now();
    m_search.restart();
    return {m_attack.step(world, m_walk, aimFrom(world, ball)), Intention::Ball, ball, false};
  }
  // Seen by a team-mate or remembered. If it is not there, it is looked for.
  constexpr double patience = 4.0;  // s at a place where no ball is
  if (!world.localized()) return lookForBall(world);
  const bool shouldSee = distance(world.pose().position, ball) < 1.5;
  if (!shouldSee) m_told = world.now();
  if (world.now() - m_told > patience) return lookForBall(world);
  const Pose there{ball, direction(world.pose().position, ball)};
  const auto act = m_walk.step(world, {there, 0.5, 0.5, false});
  return {act.value_or(acts::turnRight), Intention::Ball, ball, true};
}

bool Striker::takesBall(const WorldModel& world, const Point& ball) const {
  // Who has it keeps it: two that swap for every centimetre reach nothing.
  constexpr double keeps = 0.1, takes = -0.3;  // m
  return !mateIsFirst(world, ball, m_attacking ? keeps : takes);
}

Choice Striker::play(const WorldModel& world) {
  const auto ball = world.ball();
  if (!ball) {
    m_attacking = false;
    return lookForBall(world);
  }
  m_attacking = !world.localized() || takesBall(world, *ball);
  if (m_attacking) return toBall(world, *ball);
  m_search.restart();
  return walkTo(world, supportPose(world, *ball), Intention::Support, 0.25);
}

Pose Striker::supportPose(const WorldModel& world, const Point& ball) const {
  const sim::FieldSpec& field = world.field();
  const double side = world.pose().position.y > ball.y ? 1.0 : -1.0;
  Point place{ball.x - 1.2, ball.y + 1.0 * side};
  if (std::abs(place.y) > field.halfWidth() - 0.4) place.y = ball.y - 1.0 * side;
  place.x = std::clamp(place.x, -field.halfLength() + 1.2, field.halfLength() - 1.0);
  return {place, direction(place, ball)};
}

Pose Striker::kickOff(const WorldModel& world) {
  return {{-0.5 * world.field().centreCircleDiameter - 0.35, 0.0}, 0.0};
}

Pose Supporter::kickOff(const WorldModel& world) {
  const double x = -0.25 * world.field().length, y = 0.22 * world.field().width;
  // The nearer side, unless a team-mate is nearer to it: two supporters take one each. Chosen once
  // for a kick-off, so that nobody changes sides on the way.
  constexpr double forgets = 5.0;  // s
  if (world.now() - m_sideAsked > forgets) {
    m_side = world.pose().position.y >= 0.0 ? 1.0 : -1.0;
    const Point place{x, m_side * y};
    const double own = distance(world.pose().position, place);
    // Everybody just walks then: of three or more (a keeper, too) the one nearest to the striker's
    // place is taken for the striker, who needs none of these.
    const Point front = Striker::kickOff(world).position;
    const TeamMate* striker = nullptr;
    int mates = 0;
    for (const auto& mate : world.mates()) {
      if (!mate) continue;
      ++mates;
      if (!striker || distance(mate->position, front) < distance(striker->position, front)) {
        striker = &*mate;
      }
    }
    if (mates < 3) striker = nullptr;
    for (const auto& mate : world.mates()) {
      const bool supports = mate && &*mate != striker && mate->intention != Intention::Keep;
      if (supports && distance(mate->position, place) < own - 0.05 &&
          distance(mate->position, place) < distance(mate->position, {x, -m_side * y})) {
        m_side = -m_side;
        break;
      }
    }
  }
  m_sideAsked = world.now();
  return {{x, m_side * y}, 0.0};
}

bool Supporter::takesBall(const WorldModel& world, const Point& ball) const {
  const double own = distance(world.pose().position, ball);
  bool somebodyAttacks = false;
  double nearest = 1e9;
  for (const auto& mate : world.mates()) {
    if (!mate || !mate->active || mate->intention == Intention::Keep) continue;
    somebodyAttacks = somebodyAttacks || mate->intention == Intention::Ball;
    if (mate->intention == Intention::Ball)
      nearest = std::min(nearest, distance(mate->position, ball));
  }
  if (!somebodyAttacks) return true;
  return own < nearest - (m_attacking ? 0.2 : 0.8);
}

Pose Keeper::kickOff(const WorldModel& world) {
  return {{-world.field().halfLength() + 0.45, 0.0}, 0.0};
}

Choice Keeper::play(const WorldModel& world) {
  const auto ball = world.ball();
  if (!world.localized() || !ball) {
    m_clearing = false;
    if (world.localized() && distance(world.pose().position, kickOff(world).position) > 0.4) {
      Choice home = walkTo(world, kickOff(world), Intention::Keep, 0.2);
      home.search = true;
      return home;
    }
    // Looks about without leaving the goal.
    return {acts::gait, Intention::Keep, {}, true};
  }
  constexpr double clearWithin = 1.3, clearUntil = 1.9;  // m from the goal's centre
  const double fromGoal = distance(*ball, world.ownGoal());
  m_clearing = world.seesBall() && fromGoal < (m_clearing ? clearUntil : clearWithin) &&
               !mateIsFirst(world, *ball, 0.5);
  if (m_clearing) {
    Choice choice = toBall(world, *ball);
    choice.intention = Intention::Ball;
    return choice;
  }
  // On the line from the ball to the goal, on an arc before it that covers the posts.
  const double arc = 0.40 * world.field().goalWidth;
  const double angle = std::clamp(direction(world.ownGoal(), *ball), -1.2, 1.2);
  const Point place{world.ownGoal().x + 0.2 + 0.6 * arc * repeatable::cos(angle),
                    world.ownGoal().y + arc * repeatable::sin(angle)};
  Choice choice = walkTo(world, {place, 0.5 * angle}, Intention::Keep, 0.12);
  choice.search = !world.seesBall();
  return choice;
}

}  // namespace pitchboard::link
