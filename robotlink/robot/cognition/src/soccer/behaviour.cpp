// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/behaviour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <base/angles.h>
#include <base/repeatable_math.h>

#include "soccer/arrival.h"
#include "soccer/kick_choice.h"
#include "soccer/roles.h"

namespace pitchboard::link {
namespace {

/// How far beyond a line it stands, m; negative on the field.
double beyondLines(const WorldModel& world) {
  const Point& at = world.pose().position;
  return std::max(std::abs(at.x) - world.field().halfLength(),
                  std::abs(at.y) - world.field().halfWidth());
}

/// The ball lies before the own goal with an opponent near it.
bool isDangerous(const WorldModel& world, const Point& ball, double within) {
  constexpr double near = 1.5;  // m
  return distance(ball, world.ownGoal()) < within &&
         std::ranges::any_of(world.opponents(), [&](const Point& opponent) {
           return distance(opponent, ball) < near;
         });
}

}  // namespace

Choice Behaviour::choose(const WorldModel& world) {
  if (world.fallen()) return {acts::stop, Intention::None, {}, false};  // control gets it up
  switch (world.referee()) {
    case Referee::Play:
      return comesBack(world) ? enter(world) : play(world);
    case Referee::Ready:
      if (world.localized()) {
        if (world.setPlay() != SetPlay::None) return waitForSetPlay(world);
        Choice choice = goTo(world, kickOff(world), atKickOff());
        if (auto* target = std::get_if<Target>(&choice.move)) target->forwards = true;
        choice.search = true;
        return choice;
      }
      // Standing it may see the same two corners for ever, and they do not say where it is.
      m_search.restart();
      return {acts::turnRight, Intention::Idle, {}, true};
    case Referee::None:
    case Referee::Stop:
    case Referee::Set:
      break;
  }
  m_search.restart();
  comesBack(world);
  // Standing, it still looks where the ball is.
  return {acts::stop, Intention::Idle, {}, true};
}

/// Stood beside the field while it had to stand, as whoever serves a penalty does, and is not on it
/// yet.
bool Behaviour::comesBack(const WorldModel& world) {
  constexpr double outside = 0.2, inside = -0.1;  // m
  if (!world.localized()) return false;
  const double beyond = beyondLines(world);
  if (world.referee() != Referee::Play) {
    m_comesBack = beyond > outside;
  } else if (beyond < inside) {
    m_comesBack = false;
  }
  return m_comesBack;
}

/// A robot that returns from a penalty first walks straight onto the field, which it faces.
Choice Behaviour::enter(const WorldModel& world) {
  const sim::FieldSpec& field = world.field();
  constexpr double inside = 0.6;  // m
  const Point at = world.pose().position;
  const double x = field.halfLength() - inside, y = field.halfWidth() - inside;
  const Point place{std::clamp(at.x, -x, x), std::clamp(at.y, -y, y)};
  Choice choice = goTo(world, {place, direction(at, place)}, Intention::Walk);
  choice.search = true;
  return choice;
}

/// The other team has the ball: away from it, to where it is needed next.
Choice Behaviour::waitForSetPlay(const WorldModel& world) {
  Choice choice = play(world);
  const auto ball = world.ball();
  constexpr double room = 1.1;  // m, more than any rule asks for
  const Point at = world.pose().position;
  if (!ball) return {acts::stop, choice.intention, {}, true};
  if (distance(at, *ball) < room) {
    // Towards the own goal, out of its way.
    const double away = direction(*ball, world.ownGoal());
    const auto [s, c] = repeatable::sinCos(away);
    const Point place{ball->x + 1.3 * room * c, ball->y + 1.3 * room * s};
    Choice back = goTo(world, {place, direction(place, *ball)}, Intention::Support);
    back.search = true;
    return back;
  }
  const Target* target = std::get_if<Target>(&choice.move);
  if (target && distance(target->pose.position, *ball) > room) return choice;
  return {acts::stop, choice.intention, {}, true};
}

Choice Behaviour::goTo(const WorldModel& world, const Pose& pose, Intention intention,
                       double near) {
  const auto target = walkTo(world, pose, near, 0.35, Ball::KeepClear);
  return {target ? Move(*target) : acts::stop, intention, pose.position, !world.seesBall()};
}

Choice Behaviour::lookForBall(const WorldModel& world) {
  return {m_search.step(world), Intention::Search, {}, true};
}

/// `ball`: where it will lie.
Choice Behaviour::toBall(const WorldModel& world, const Point& ball) {
  if (world.seesBall()) {
    m_ballConfirmed = world.now();
    m_search.restart();
    constexpr double rolls = 0.6;  // m: it is met where it stops
    const Point here = world.toField(world.ballInFront());
    if (distance(here, ball) > rolls && distance(world.pose().position, here) > rolls) {
      const auto target = walkTo(world, {ball, direction(ball, here)}, 0.3, 0.5, Ball::KeepClear);
      return {target ? Move(*target) : acts::gait, Intention::Ball, ball, false};
    }
    const bool clears = isDangerous(world, here, m_numbers.clearDanger);
    return {m_attack.step(world, aimFrom(world, here, m_numbers.aimSide), clears), Intention::Ball,
            here, false};
  }
  // Seen by a team-mate or remembered. If it is not there, it is looked for.
  if (!world.localized()) return lookForBall(world);
  const bool shouldSee = distance(world.pose().position, ball) < 1.5;
  if (!shouldSee) m_ballConfirmed = world.now();
  if (world.now() - m_ballConfirmed > m_numbers.patience) return lookForBall(world);
  const Pose there{ball, direction(world.pose().position, ball)};
  const auto target = walkTo(world, there, 0.5, 0.5, Ball::Ignore);
  return {target ? Move(*target) : acts::turnRight, Intention::Ball, ball, true};
}

/// The robot that goes for the ball keeps doing so for a while; if two robots swapped for every
/// centimetre, neither would get there.
bool Behaviour::takesBall(const WorldModel& world, const Point& ball, bool has) const {
  const double own = secondsToBall(world, ball);
  const double away = distance(world.pose().position, ball);
  for (const auto& mate : world.mates()) {
    if (!mate || !mate->takesPart()) continue;
    const bool goes = mate->intention == Intention::Ball;
    const double its = secondsToBallFrom(world, mate->position, ball);
    if (has) {
      if (goes && its < own - m_numbers.leavesAfter) return false;
    } else if (goes) {
      if (own > its - m_numbers.takesAfter) return false;
    } else if (mate->intention != Intention::Keep &&
               distance(mate->position, ball) + pathLengthAround(mate->position, ball) <
                   away + pathLengthAround(world.pose().position, ball)) {
      return false;
    }
  }
  return true;
}

Choice Striker::play(const WorldModel& world) {
  const auto ball = world.ballStops();
  if (!ball) {
    m_attacking = false;
    return lookForBall(world);
  }
  m_attacking = !world.localized() || takesBall(world, *ball, m_attacking);
  if (!m_attacking) {
    m_search.restart();
    return support(world, *ball);
  }
  m_place.reset();
  return toBall(world, *ball);
}

Choice Striker::support(const WorldModel& world, const Point& ball) {
  constexpr double middle = 0.5;  // m: there neither side has more room
  if (std::abs(ball.y) > middle) m_side = ball.y > 0.0 ? -1.0 : 1.0;
  Points robots{world.pose().position};
  for (const auto& mate : world.mates()) {
    if (mate && mate->takesPart() && mate->intention == Intention::Support)
      robots.push_back(mate->position);
  }
  const double passRange = std::min(2.0, kickRange(world, acts::passLeft));
  Points places;
  for (const Placing& placing :
       placingsFor(world.field(), ball, m_side, passRange, robots.size())) {
    places.push_back(placing.place);
  }
  // It keeps its place a little longer than the ways alone say, unless a team-mate is nearer to it:
  // two that both keep the same one would meet there.
  const auto isNearer = [&](const Point& other) {
    return distance(other, places[*m_place]) < distance(robots.front(), places[*m_place]);
  };
  if (m_place &&
      (*m_place >= places.size() || std::any_of(robots.begin() + 1, robots.end(), isNearer))) {
    m_place.reset();
  }
  m_place = placeOf(robots, places, m_place);
  const Point place = places[*m_place];
  Choice choice = goTo(world, {place, direction(place, ball)}, Intention::Support, 0.25);
  if (auto* target = std::get_if<Target>(&choice.move)) target->apart = true;
  return choice;
}

Pose Striker::kickOff(const WorldModel& world) {
  return {{-0.5 * world.field().centreCircleDiameter - 0.35, 0.0}, 0.0};
}

/// Where supporters stand, each in a place of its own: whoever is nearest to one takes it, and
/// everybody works out the same from what the team tells. Settled soon, so that nobody changes
/// places on the way.
Pose Supporter::kickOff(const WorldModel& world) {
  constexpr double forgets = 5.0, settles = 1.0;  // s; until all have told that they support
  Points robots{world.pose().position};
  for (const auto& mate : world.mates()) {
    if (mate && mate->intention == Intention::Support) robots.push_back(mate->position);
  }
  // Three of a large team report what they do; of the others only the places are known.
  constexpr std::size_t reported = maxTeamMates;
  const auto supporters = static_cast<std::ptrdiff_t>(robots.size()) - 1;
  if (world.matePlaces().size() > reported) {
    robots.shrink(1);
    for (const Point& place : world.matePlaces()) robots.push_back(place);
  }
  Points places = kickOffPlaces(world.field());
  // Two take the sides.
  places.shrink(std::max<std::size_t>(2, robots.size()));
  robots.shrink(places.size());
  if (world.now() - m_placeAsked > forgets || supporters != m_supporters) {
    m_placeBegan = world.now();
    m_supporters = supporters;
  }
  if (world.now() - m_placeBegan < settles || m_kickOffPlace >= places.size()) {
    m_kickOffPlace = placeOf(robots, places);
  } else if (mateHolds(world, places[m_kickOffPlace])) {
    m_kickOffPlace = nearestNotHeld(world, places, m_kickOffPlace);
  }
  m_placeAsked = world.now();
  return {besideStanding(world, places[m_kickOffPlace]), 0.0};
}

/// Returns a place beside robots that stand still because they do not take part.
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

/// Two whose beliefs differed chose the same place: who is there later gives way.
bool Supporter::mateHolds(const WorldModel& world, const Point& place) {
  constexpr double there = 0.6, asNear = 0.15;  // m
  const Point own = world.pose().position;
  return std::ranges::any_of(world.mates(), [&](const auto& mate) {
    if (!mate || mate->intention != Intention::Support) return false;
    const double gap = distance(mate->position, place);
    const double farther = distance(own, place) - gap;  // this robot, than the mate
    // At equal distance every robot decides for the one on the left.
    const bool stays = farther > asNear || (farther > -asNear && mate->position.y > own.y);
    return gap < there && stays;
  });
}

std::size_t Supporter::nearestNotHeld(const WorldModel& world, std::span<const Point> places,
                                      std::size_t otherwise) {
  std::size_t nearest = otherwise;
  double least = 1e9;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double gap = distance(world.pose().position, places[i]);
    if (gap >= least || mateHolds(world, places[i])) continue;
    nearest = i;
    least = gap;
  }
  return nearest;
}

/// On the line from the ball to the goal, where it crosses an arc in front of the posts; to the
/// side by `keeperAside` and by what the advisor says.
Pose Keeper::keeperPlace(const WorldModel& world, const Point& ball) const {
  const Point goal = world.ownGoal();
  const double arc = m_numbers.keeperArc * world.field().goalWidth;
  const double angle = std::clamp(direction(goal, ball), -1.2, 1.2);
  const double aside = m_numbers.keeperAside + world.keeperShift();
  Pose place{{goal.x + m_numbers.keeperLine + 0.6 * arc * repeatable::cos(angle),
              goal.y + arc * repeatable::sin(angle)},
             0.5 * angle};
  if (aside != 0.0) place.position.y += aside;
  return place;
}

Pose Keeper::kickOff(const WorldModel& world) {
  return {{-world.field().halfLength() + 0.45, 0.0}, 0.0};
}

/// To one that is near, and to one farther out when nobody is there sooner.
bool Keeper::goesForBall(const WorldModel& world, const Point& ball) const {
  constexpr double surely = 1.0;  // s
  const double fromGoal = distance(ball, world.ownGoal());
  const double clearUntil = std::max(m_numbers.clearUntil, m_numbers.clearWithin);
  if (!world.seesBall()) return false;
  const double own = secondsToBall(world, ball) + (m_clearing ? -surely : surely);
  double others = 1e9;
  for (const auto& mate : world.mates()) {
    if (mate && mate->takesPart())
      others = std::min(others, secondsToBallFrom(world, mate->position, ball));
  }
  const bool mateIsFirst = others < own;
  for (const Point& opponent : world.opponents()) {
    others = std::min(others, secondsFrom(world, opponent, ball));
  }
  const double near = m_clearing ? clearUntil : m_numbers.clearWithin;
  return (fromGoal < near && !mateIsFirst) || (fromGoal < m_numbers.keeperOut && own < others);
}

Choice Keeper::play(const WorldModel& world) {
  const auto ball = world.ballStops();
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
  m_clearing = goesForBall(world, *ball);
  if (m_clearing) {
    Choice choice = toBall(world, *ball);
    choice.intention = Intention::Ball;
    return choice;
  }
  Choice choice = goTo(world, keeperPlace(world, *ball), Intention::Keep, 0.12);
  choice.search = !world.seesBall();
  return choice;
}

}  // namespace pitchboard::link
