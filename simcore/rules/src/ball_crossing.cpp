// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball_crossing.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::sim {
namespace {

// Robots move a little in a tick, so what stands about in the way counts as in it.
constexpr double margin = 0.02;

double toSegment(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along = (p.x - a.x) * dx + (p.y - a.y) * dy;
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  const double x = a.x + t * dx - p.x, y = a.y + t * dy - p.y;
  return std::sqrt(x * x + y * y);
}

constexpr double never = 2.0;

/// When on the way from inside to `to` a line at ± `at` is crossed, as a share of the way.
double crossedAt(double from, double to, double at) {
  if (std::abs(to) <= at) return never;
  const double start = to > 0.0 ? from : -from;
  return (at - start) / (std::abs(to) - start);
}

/// The first line on the straight way from inside to a place that is not.
Crossing crossingBetween(const FieldSpec& field, const Point& from, const Point& to) {
  const double end = crossedAt(from.x, to.x, field.halfLength() + field.ballRadius);
  const double touch = crossedAt(from.y, to.y, field.halfWidth() + field.ballRadius);
  const double t = std::min(end, touch);
  Crossing crossing;
  if (t > 1.0) return crossing;
  crossing.where = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
  if (end <= touch) {
    const bool between = std::abs(crossing.where.y) < field.goalWidth / 2.0;
    crossing.line = between ? Crossing::Line::Goal : Crossing::Line::End;
    crossing.right = to.x > 0.0;
  } else {
    crossing.line = Crossing::Line::Touch;
    crossing.right = to.y > 0.0;
  }
  return crossing;
}

/// Walls stop a ball, maybe before all of it is over a line.
Point withinWalls(const FieldSpec& field, const Point& p) {
  const double x = field.halfLength() + field.border - field.ballRadius;
  const double y = field.halfWidth() + field.border - field.ballRadius;
  return {std::clamp(p.x, -x, x), std::clamp(p.y, -y, y)};
}

bool isFree(const FieldSpec& field, const Point& from, const Point& to,
            std::span<const Standing> robots) {
  for (const double x : {-field.halfLength(), field.halfLength()}) {
    for (const double y : {-field.goalWidth / 2.0, field.goalWidth / 2.0}) {
      if (toSegment({x, y}, from, to) < field.goalPostRadius + field.ballRadius) return false;
    }
  }
  return std::none_of(robots.begin(), robots.end(), [&](const Standing& robot) {
    return toSegment(robot.place, from, to) < robot.radius + field.ballRadius + margin;
  });
}

}  // namespace

bool isInField(const FieldSpec& field, const Point& ball) {
  return std::abs(ball.x) - field.ballRadius <= field.halfLength() &&
         std::abs(ball.y) - field.ballRadius <= field.halfWidth();
}

bool isInGoal(const FieldSpec& field, const Point& ball) {
  return std::abs(ball.x) - field.ballRadius > field.halfLength() &&
         std::abs(ball.x) < field.halfLength() + field.goalDepth &&
         std::abs(ball.y) < field.goalWidth / 2.0;
}

Crossing crossingOf(const FieldSpec& field, const BallSweep& sweep, const Point& now,
                    std::span<const Standing> robots) {
  if (!isInField(field, sweep.from)) return {};
  const bool isOut = !isInField(field, now);
  const Point aim = withinWalls(field, sweep.aim);
  if (!isOut && isInField(field, aim)) return {};
  if (isOut) {
    // The nets hold the ball, so its centre between the posts means that it came in that way.
    if (isInGoal(field, now)) return {Crossing::Line::Goal, now, now.x > 0.0};
    Crossing crossing = crossingBetween(field, sweep.from, now);
    if (crossing.line == Crossing::Line::Goal) crossing.line = Crossing::Line::End;
    return crossing;
  }
  // It is back already: it was out unless something stopped it before the line.
  const Crossing crossing = crossingBetween(field, sweep.from, aim);
  if (crossing.line == Crossing::Line::None || !isFree(field, sweep.from, crossing.where, robots)) {
    return {};
  }
  return crossing;
}

}  // namespace pitchboard::sim
