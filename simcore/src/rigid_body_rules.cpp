// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_rules.h"

#include <algorithm>

namespace pitchboard::sim::rigid {
namespace {

void scoreGoal(Tick& tick) {
  if (!tick.world.clockRunning) return;
  const bool leftScored = tick.state.ball.position.x > 0.0;
  ++(leftScored ? tick.world.score.left : tick.world.score.right);
  tick.events.push_back({EventKind::Goal, tick.world.tick, RobotId{}, leftScored ? 0 : 1});
  if (tick.settings().afterGoal == AfterGoal::StopClock) {
    tick.world.clockRunning = false;
  } else {
    tick.state.ball = {};
  }
}

}  // namespace

void applyMatchRules(Tick& tick) {
  const FieldSpec& field = tick.settings().field;
  RigidBall& ball = tick.state.ball;
  const bool overEnd = std::abs(ball.position.x) - field.ballRadius > field.halfLength();
  const bool overSide = std::abs(ball.position.y) - field.ballRadius > field.halfWidth();
  if (!overEnd && !overSide) return;
  // The nets hold the ball, so its centre between the posts means that all of it is there.
  if (overEnd && std::abs(ball.position.y) < field.goalWidth / 2.0) {
    scoreGoal(tick);
    return;
  }
  const double x = std::max(0.0, field.halfLength() - replacementDistance);
  const double y = std::max(0.0, field.halfWidth() - replacementDistance);
  ball.position = {std::clamp(ball.position.x, -x, x), std::clamp(ball.position.y, -y, y)};
  ball.velocity = {};
  tick.events.push_back({EventKind::BallOut, tick.world.tick, RobotId{}, 0});
}

}  // namespace pitchboard::sim::rigid
