// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/rules/rigid_body_rules.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::sim::rigid {
namespace {

void scoreGoal(WorldState& world, RigidBall& ball, std::vector<Event>& events) {
  if (!world.clockRunning) return;
  const bool leftScored = ball.position.x > 0.0;
  ++(leftScored ? world.score.left : world.score.right);
  events.push_back({EventKind::Goal, world.tick, RobotId{}, leftScored ? 0 : 1});
  if (world.settings.afterGoal == AfterGoal::StopClock) {
    world.clockRunning = false;
  } else {
    ball = {};
  }
}

}  // namespace

void applyMatchRules(WorldState& world, RigidBodyState& state, std::vector<Event>& events) {
  const FieldSpec& field = world.settings.field;
  RigidBall& ball = state.ball;
  const bool overEnd = std::abs(ball.position.x) - field.ballRadius > field.halfLength();
  const bool overSide = std::abs(ball.position.y) - field.ballRadius > field.halfWidth();
  if (!overEnd && !overSide) return;
  // The nets hold the ball, so its centre between the posts means that all of it is there.
  if (overEnd && std::abs(ball.position.y) < field.goalWidth / 2.0) {
    scoreGoal(world, ball, events);
    return;
  }
  const double x = std::max(0.0, field.halfLength() - replacementDistance);
  const double y = std::max(0.0, field.halfWidth() - replacementDistance);
  ball.position = {std::clamp(ball.position.x, -x, x), std::clamp(ball.position.y, -y, y)};
  ball.velocity = {};
  events.push_back({EventKind::BallOut, world.tick, RobotId{}, 0});
}

}  // namespace pitchboard::sim::rigid
