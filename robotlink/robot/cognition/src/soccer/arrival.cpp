// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/arrival.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <base/angles.h>

#include <robotlink/cognition/act.h>

namespace pitchboard::link {
namespace {

using std::numbers::pi;

constexpr double unknownTurn = pi / 4;  // half of the turn that most need

double secondsFor(const WorldModel& world, double turn, double metres) {
  const double turns = sim::gaitSpeed(world.body(), acts::turnLeft.action, 0).turn;
  return std::abs(turn) / std::max(0.05, turns) + metres / walkingSpeed(world);
}

}  // namespace

double walkingSpeed(const WorldModel& world) {
  const auto gait = sim::gaitSpeed(world.body(), acts::forward.action, acts::forward.b);
  return std::max(0.01, gait.forward);
}

double pathLengthAround(const Point& robot, const Point& ball) {
  constexpr double round = 0.35;  // m from the ball
  const double off = std::abs(wrapToPi(direction(robot, ball)));
  return std::max(0.0, off - pi / 2) * round;
}

double secondsTo(const WorldModel& world, const Point& place) {
  const Pose& from = world.pose();
  const double metres = distance(from.position, place);
  constexpr double there = 0.3;  // m: who is so near has no way to turn to
  const double turn = metres < there ? 0.0 : wrapToPi(direction(from.position, place) - from.yaw);
  return secondsFor(world, turn, metres);
}

double secondsFrom(const WorldModel& world, const Point& from, const Point& place) {
  return secondsFor(world, unknownTurn, distance(from, place));
}

double secondsToBall(const WorldModel& world, const Point& ball) {
  return secondsTo(world, ball) +
         secondsFor(world, 0.0, pathLengthAround(world.pose().position, ball));
}

double secondsToBallFrom(const WorldModel& world, const Point& from, const Point& ball) {
  return secondsFrom(world, from, ball) + secondsFor(world, 0.0, pathLengthAround(from, ball));
}

}  // namespace pitchboard::link
