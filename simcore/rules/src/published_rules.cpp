// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/rules/published_rules.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <simcore/world/published_geometry.h>

#include "ball_crossing.h"

namespace pitchboard::sim {
namespace {

// In the published frame, with the published operations (published-exact.md "Ball").

bool liesInGoal(const PublishedGeometry& g, const PublishedBall& ball, double x1, double x2) {
  const double r = g.ballRadius;
  return ball.x - r > x1 && ball.x + r < x2 && ball.y - r > g.goalTop && ball.y + r < g.goalBottom;
}

void scoreGoal(WorldState& world, bool leftGoal, std::vector<Event>& events) {
  if (!world.clockRunning) return;
  ++(leftGoal ? world.score.right : world.score.left);
  world.clockRunning = false;
  events.push_back({EventKind::Goal, world.tick, RobotId{}, leftGoal ? 1 : 0});
}

void putBackWhenOut(const PublishedGeometry& g, PublishedBall& ball, std::uint64_t tick,
                    std::vector<Event>& events) {
  const double r = g.ballRadius;
  const double left = g.left + g.replaceMargin;
  const double right = g.right - g.replaceMargin;
  const double top = g.top + g.replaceMargin;
  const double bottom = g.bottom - g.replaceMargin;
  const auto stopBall = [&] {
    ball.vx = ball.vy = 0.0;
    events.push_back({EventKind::BallOut, tick, RobotId{}, 0});
  };
  if (ball.x - r > g.right || ball.x + r < g.left) {
    ball.x = ball.x - r > g.right ? right : left;
    ball.y = std::clamp(ball.y, top, bottom);
    stopBall();
  }
  if (ball.y - r > g.bottom || ball.y + r < g.top) {
    ball.y = ball.y - r > g.bottom ? bottom : top;
    ball.x = std::clamp(ball.x, left, right);
    stopBall();
  }
}

void applyRules(WorldState& world, PublishedState& state, const BallSweep& /*sweep*/,
                std::vector<Event>& events) {
  const PublishedGeometry g(world.settings.field);
  PublishedBall& ball = state.ball;
  if (liesInGoal(g, ball, g.left - g.goalDepth, g.left)) {
    scoreGoal(world, true, events);
  } else if (liesInGoal(g, ball, g.right, g.right + g.goalDepth)) {
    scoreGoal(world, false, events);
  } else {
    putBackWhenOut(g, ball, world.tick, events);
  }
}

// The same in metres.

constexpr double replacementDistance = 1.0;

void scoreGoal(WorldState& world, RigidBall& ball, bool leftScored, std::vector<Event>& events) {
  if (!world.clockRunning) return;
  ++(leftScored ? world.score.left : world.score.right);
  events.push_back({EventKind::Goal, world.tick, RobotId{}, leftScored ? 0 : 1});
  if (world.settings.afterGoal == AfterGoal::StopClock) {
    world.clockRunning = false;
  } else {
    ball = {};
  }
}

void applyRules(WorldState& world, RigidBodyState& state, const BallSweep& sweep,
                std::vector<Event>& events) {
  const FieldSpec& field = world.settings.field;
  RigidBall& ball = state.ball;
  if (isInField(field, ball.position) && isInField(field, sweep.aim)) return;
  std::array<Standing, highestRobotNumber> robots;
  const std::size_t count = std::min(robots.size(), state.robots.size());
  for (std::size_t i = 0; i < count; ++i)
    robots[i] = {state.robots[i].pose.position, robotRadius(world, i)};
  const Crossing crossing = crossingOf(field, sweep, ball.position, std::span(robots).first(count));
  if (crossing.line == Crossing::Line::Goal) {
    scoreGoal(world, ball, crossing.right, events);
    return;
  }
  Point place = crossing.where;
  if (crossing.line == Crossing::Line::None) {
    // Somebody put it there: behind a goal it is out, in a goal it lies.
    if (isInField(field, ball.position) || isInGoal(field, ball.position)) return;
    place = ball.position;
  } else if (!isInField(field, ball.position)) {
    place = ball.position;
  }
  const double x = std::max(0.0, field.halfLength() - replacementDistance);
  const double y = std::max(0.0, field.halfWidth() - replacementDistance);
  ball.position = {std::clamp(place.x, -x, x), std::clamp(place.y, -y, y)};
  ball.velocity = {};
  events.push_back({EventKind::BallOut, world.tick, RobotId{}, 0});
}

}  // namespace

void applyPublishedRules(WorldState& world, const BallSweep& sweep, std::vector<Event>& events) {
  std::visit([&](auto& state) { applyRules(world, state, sweep, events); }, world.physics);
}

}  // namespace pitchboard::sim
