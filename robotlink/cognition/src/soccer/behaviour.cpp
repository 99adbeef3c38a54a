// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/behaviour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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
        Choice choice = goTo(world, kickOff(world), atKickOff());
        choice.search = true;
        return choice;
      }
      // Standing it may see the same two corners for ever, and they do not say where it is.
      m_search.restart();
      return {acts::turnRight, Intention::Idle, {}, true};
    case Referee::Silent:
    case Referee::Stop:
    case Referee::Set:
      break;
  }
  m_search.restart();
  // Standing, it still looks where the ball is.
  return {acts::stop, Intention::Idle, {}, true};
}

Choice Behaviour::goTo(const WorldModel& world, const Pose& pose, Intention intention,
                       double near) {
  const auto target = walkTo(world, pose, near, 0.35, Ball::KeepClear);
  return {target ? Move(*target) : acts::stop, intention, pose.position, !world.seesBall()};
}

Choice Behaviour::lookForBall(const WorldModel& world) {
  return {m_search.step(world), Intention::Search, {}, true};
}

Choice Behaviour::toBall(const WorldModel& world, const Point& ball) {
  if (world.seesBall()) {
    m_told = world.now();
    m_search.restart();
    return {m_attack.step(world, aimFrom(world, ball)), Intention::Ball, ball, false};
  }
  // Seen by a team-mate or remembered. If it is not there, it is looked for.
  if (!world.localized()) return lookForBall(world);
  const bool shouldSee = distance(world.pose().position, ball) < 1.5;
  if (!shouldSee) m_told = world.now();
  if (world.now() - m_told > m_numbers.patience) return lookForBall(world);
  const Pose there{ball, direction(world.pose().position, ball)};
  const auto target = walkTo(world, there, 0.5, 0.5, Ball::Ignore);
  return {target ? Move(*target) : acts::turnRight, Intention::Ball, ball, true};
}

bool Striker::takesBall(const WorldModel& world, const Point& ball) const {
  // Who has it keeps it: two that swap for every centimetre reach nothing.
  return !mateIsFirst(world, ball, m_attacking ? m_numbers.leavesBall : -m_numbers.takesBall);
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
  return goTo(world, supportPose(world, *ball), Intention::Support, 0.25);
}

Pose Striker::supportPose(const WorldModel& world, const Point& ball) const {
  const sim::FieldSpec& field = world.field();
  const double side = world.pose().position.y > ball.y ? 1.0 : -1.0;
  const double beside = m_numbers.supportBeside * side;
  Point place{ball.x - m_numbers.supportBehind, ball.y + beside};
  if (std::abs(place.y) > field.halfWidth() - 0.4) place.y = ball.y - beside;
  place.x = std::clamp(place.x, -field.halfLength() + 1.2, field.halfLength() - 1.0);
  return {place, direction(place, ball)};
}

Pose Striker::kickOff(const WorldModel& world) {
  return {{-0.5 * world.field().centreCircleDiameter - 0.35, 0.0}, 0.0};
}

/// Where supporters stand, each in a place of its own: whoever is nearest to one takes it, and
/// everybody works out the same from what the team tells. Settled soon, so that nobody changes
/// places on the way.
Pose Supporter::kickOff(const WorldModel& world) {
  constexpr double forgets = 5.0, settles = 1.0;  // s; until all have told that they support
  const double x = -0.25 * world.field().length, y = 0.22 * world.field().width;
  const std::array<Point, mostTeamMates + 1> places{{{x, y}, {x, -y}, {x, 0.0}, {x - 1.0, 0.0}}};
  const auto supporters = std::ranges::count_if(world.mates(), [](const auto& mate) {
    return mate && mate->intention == Intention::Support;
  });
  if (world.now() - m_placeAsked > forgets || supporters != m_supporters) {
    m_placeBegan = world.now();
    m_supporters = supporters;
  }
  if (world.now() - m_placeBegan < settles) {
    m_place = freePlace(world, places);
  } else if (mateHolds(world, places[m_place])) {
    m_place = nearestNotHeld(world, {places.data(), placesFor(m_supporters)}, m_place);
  }
  m_placeAsked = world.now();
  return {besideStanding(world, places[m_place]), 0.0};
}

/// Who does not take part stays where it is: beside it, not against it.
Point Supporter::besideStanding(const WorldModel& world, Point place) {
  const double least = 2.0 * world.field().robotRadius + 0.2;  // m
  for (const auto& mate : world.mates()) {
    const bool stands =
        mate && (mate->intention == Intention::None || mate->intention == Intention::Idle);
    const double away = stands ? distance(place, mate->position) : least;
    if (away >= least) continue;
    // Away from it; from exactly the same place towards the own goal.
    const Point to =
        away > 0.0 ? Point{(place.x - mate->position.x) / away, (place.y - mate->position.y) / away}
                   : Point{-1.0, 0.0};
    place = {mate->position.x + least * to.x, mate->position.y + least * to.y};
  }
  return place;
}

/// As many places as supporters; two take the sides.
std::size_t Supporter::placesFor(std::ptrdiff_t mates) {
  return std::max<std::size_t>(2, static_cast<std::size_t>(mates) + 1);
}

/// Two whose beliefs differed chose the same place: who is there later gives way.
bool Supporter::mateHolds(const WorldModel& world, const Point& place) {
  constexpr double there = 0.6, asNear = 0.15;  // m
  const Point own = world.pose().position;
  return std::ranges::any_of(world.mates(), [&](const auto& mate) {
    if (!mate || mate->intention != Intention::Support) return false;
    const double way = distance(mate->position, place);
    const double farther = distance(own, place) - way;  // this robot, than the mate
    // Both as near: the one on the left stays, whoever asks.
    const bool stays = farther > asNear || (farther > -asNear && mate->position.y > own.y);
    return way < there && stays;
  });
}

std::size_t Supporter::nearestNotHeld(const WorldModel& world, std::span<const Point> places,
                                      std::size_t otherwise) {
  std::size_t nearest = otherwise;
  double least = 1e9;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double way = distance(world.pose().position, places[i]);
    if (way >= least || mateHolds(world, places[i])) continue;
    nearest = i;
    least = way;
  }
  return nearest;
}

std::size_t Supporter::freePlace(const WorldModel& world, std::span<const Point> places) {
  std::vector<Point> supporters{world.pose().position};  // this robot first
  for (const auto& mate : world.mates()) {
    if (mate && mate->intention == Intention::Support) supporters.push_back(mate->position);
  }
  std::vector<std::size_t> free(placesFor(std::ssize(supporters) - 1));
  std::iota(free.begin(), free.end(), std::size_t{0});
  std::vector<bool> placed(supporters.size(), false);
  while (true) {
    std::size_t who = 0, where = 0;
    double least = 1e9;
    for (std::size_t s = 0; s < supporters.size(); ++s) {
      for (std::size_t f = 0; f < free.size() && !placed[s]; ++f) {
        const double way = distance(supporters[s], places[free[f]]);
        // Two of the same way: the one on the left first, whoever asks.
        const bool nearer =
            way < least - 1e-9 || (way < least + 1e-9 && supporters[s].y > supporters[who].y);
        if (!nearer) continue;
        who = s;
        where = f;
        least = way;
      }
    }
    if (who == 0) return free[where];
    placed[who] = true;
    free.erase(free.begin() + static_cast<std::ptrdiff_t>(where));
  }
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
  return own <
         nearest - (m_attacking ? m_numbers.supporterLeavesBall : m_numbers.supporterTakesBall);
}

Pose Keeper::kickOff(const WorldModel& world) {
  return {{-world.field().halfLength() + 0.45, 0.0}, 0.0};
}

Choice Keeper::play(const WorldModel& world) {
  const auto ball = world.ball();
  if (!world.localized() || !ball) {
    m_clearing = false;
    if (world.localized() && distance(world.pose().position, kickOff(world).position) > 0.4) {
      Choice home = goTo(world, kickOff(world), Intention::Keep, 0.2);
      home.search = true;
      return home;
    }
    // Looks about without leaving the goal.
    return {acts::gait, Intention::Keep, {}, true};
  }
  const double clearUntil = std::max(m_numbers.clearUntil, m_numbers.clearWithin);
  const double fromGoal = distance(*ball, world.ownGoal());
  m_clearing = world.seesBall() && fromGoal < (m_clearing ? clearUntil : m_numbers.clearWithin) &&
               !mateIsFirst(world, *ball, 0.5);
  if (m_clearing) {
    Choice choice = toBall(world, *ball);
    choice.intention = Intention::Ball;
    return choice;
  }
  // On the line from the ball to the goal, on an arc before it that covers the posts.
  const double arc = m_numbers.keeperArc * world.field().goalWidth;
  const double angle = std::clamp(direction(world.ownGoal(), *ball), -1.2, 1.2);
  const Point place{world.ownGoal().x + m_numbers.keeperLine + 0.6 * arc * repeatable::cos(angle),
                    world.ownGoal().y + arc * repeatable::sin(angle)};
  Choice choice = goTo(world, {place, 0.5 * angle}, Intention::Keep, 0.12);
  choice.search = !world.seesBall();
  return choice;
}

}  // namespace pitchboard::link
