// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the ball left the field in a tick. Computed from its way, not sampled: a ball that crosses
// the goal line and comes back from the net within one tick has crossed it. Pure; metres.

#include <span>

#include <simcore/world/ball_sweep.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

struct Crossing {
  enum class Line { None, Goal, End, Touch };
  Line line = Line::None;
  Point where;         ///< the ball's centre when all of it was over the line
  bool right = false;  ///< at the right end of the field; for a touch line: its upper one
};

/// The ball at this place is wholly within the lines, or on them.
bool isInField(const FieldSpec& field, const Point& ball);
/// The ball lies in a goal: behind its line, between the posts, before the net's back.
bool isInGoal(const FieldSpec& field, const Point& ball);

/// A robot as an obstacle.
struct Standing {
  Point place;
  double radius = 0.0;
};

/// `now`: where the ball is after the tick. `robots`: what may have stopped it on its way.
Crossing crossingOf(const FieldSpec& field, const BallSweep& sweep, const Point& now,
                    std::span<const Standing> robots);

}  // namespace pitchboard::sim
