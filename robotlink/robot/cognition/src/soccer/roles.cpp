// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/roles.h"

#include <algorithm>
#include <array>

#include <base/angles.h>
#include <base/repeatable_math.h>

namespace pitchboard::link {
namespace {

constexpr double insideLines = 0.5;  // m
constexpr double beforeGoal = 1.2;   // m: the keeper's own room
constexpr double keeps = 0.4;        // m that the place until now counts less

Point around(const Point& ball, double metres, double angle) {
  const auto [s, c] = repeatable::sinCos(angle);
  return {ball.x + metres * c, ball.y + metres * s};
}

}  // namespace

Placings placingsFor(const sim::FieldSpec& field, const Point& ball, double side, double passRange,
                     std::size_t robots) {
  Placings places;
  const double mostX = field.halfLength() - insideLines, mostY = field.halfWidth() - insideLines;
  const auto offer = [&](Role role, const Point& wanted) {
    if (places.size() >= robots) return;
    const Point at{std::clamp(wanted.x, -field.halfLength() + beforeGoal, mostX),
                   std::clamp(wanted.y, -mostY, mostY)};
    const bool free = distance(at, ball) >= placesApart &&
                      std::ranges::none_of(places, [&at](const Placing& other) {
                        return distance(at, other.place) < placesApart;
                      });
    if (free) places.push_back({role, at});
  };
  // In the way of a pass rather than at its end: kicks differ much in how far they roll, and a body
  // stops the ball.
  constexpr double beforeItsEnd = 0.6, behind = 1.2, wingFarther = 0.2;  // m
  constexpr double beside = radiansFromDegrees(75);
  const double metres = std::max(placesApart, passRange) - beforeItsEnd;
  offer(Role::PassOffer, around(ball, metres, side * beside));
  offer(Role::Cover, {ball.x - behind, 0.8 * ball.y});
  offer(Role::Wing, around(ball, metres + wingFarther, -side * beside));
  // Everybody else behind the ball, in rows from touch line to touch line.
  constexpr std::array<double, 5> across{0.0, 0.22, -0.22, 0.44, -0.44};
  for (int row = 0; row < 8; ++row) {
    // Behind the ball, and before it when there is no more room.
    const double x = ball.x + (row < 4 ? -0.25 * (row + 1) : 0.25 * (row - 3)) * field.length;
    for (const double share : across) offer(Role::Reserve, {x, side * share * field.width});
  }
  while (places.size() < robots) places.push_back({Role::Reserve, {-beforeGoal, 0.0}});
  return places;
}

std::size_t placeOf(std::span<const Point> robots, std::span<const Point> places,
                    std::optional<std::size_t> kept) {
  InlineVector<std::size_t, Placings::capacity> free;
  for (std::size_t i = 0; i < places.size(); ++i) free.push_back(i);
  std::array<bool, Placings::capacity> placed{};
  while (true) {
    std::size_t who = 0, where = 0;
    double least = 1e9;
    for (std::size_t robot = 0; robot < robots.size(); ++robot) {
      for (std::size_t f = 0; f < free.size() && !placed[robot]; ++f) {
        const double metres = distance(robots[robot], places[free[f]]) -
                              (robot == 0 && kept == free[f] ? keeps : 0.0);
        // At equal distance every robot decides for the one on the left.
        const bool nearer =
            metres < least - 1e-9 || (metres < least + 1e-9 && robots[robot].y > robots[who].y);
        if (!nearer) continue;
        who = robot;
        where = f;
        least = metres;
      }
    }
    if (who == 0) return free[where];
    placed[who] = true;
    free.erase(free.begin() + where);
  }
}

InlineVector<Point, 22> kickOffPlaces(const sim::FieldSpec& field) {
  const double l = field.length, w = field.width;
  return {{-0.25 * l, 0.22 * w}, {-0.25 * l, -0.22 * w}, {-0.25 * l, 0.0},
          {-0.36 * l, 0.0},      {-0.36 * l, 0.33 * w},  {-0.36 * l, -0.33 * w},
          {-0.11 * l, 0.36 * w}, {-0.11 * l, -0.36 * w}, {-0.38 * l, 0.16 * w},
          {-0.38 * l, -0.16 * w}};
}

}  // namespace pitchboard::link
