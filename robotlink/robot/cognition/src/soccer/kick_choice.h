// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which kick is worth more than to go on with the ball at the feet: a shot, a pass, a ball forward.
// What a kick is worth is the sum of how surely it scores, how far it brings the ball, whether a
// team-mate has it first, and how long nobody has it. Metres, radians, seconds; pure functions.

#include <optional>

#include <robotlink/cognition/act.h>
#include "soccer/world_model.h"

namespace pitchboard::link {

struct KickSituation {
  Point ball;            ///< on the field
  bool clears = false;   ///< danger before the own goal: away with it
  bool hurries = false;  ///< has stood at the ball too long: almost anything is better
};

/// One kick and what it is worth.
struct KickWorth {
  Act act;
  Point stops;  ///< where the ball comes to rest
  double worth = 0.0;
};

/// How far the ball rolls that this kick hits, m; 0 when it does not reach it.
double kickRange(const WorldModel& world, const Act& kick, const sim::BallAtFeet& ball);
/// Of the kick with the foot at the ball's side when it is hit squarely.
double kickRange(const WorldModel& world, const Act& kick);

/// Part of the opponents' goal.
struct GoalPart {
  double middle = 0.0, half = 0.0;  ///< y and half of the width between posts, m
};
/// At which a robot with this BehaviourParameters::aimSide aims.
GoalPart goalPart(const WorldModel& world, double aimSide);

/// The chance that a ball from `ball` in the direction `yaw`, rolling so far, goes in there.
double chanceOfGoal(const WorldModel& world, const Point& ball, double yaw, double range,
                    const GoalPart& part);

/// The best kick from where the robot stands and looks; nothing when to dribble is better.
std::optional<KickWorth> chooseKick(const WorldModel& world, const BehaviourParameters& numbers,
                                    const KickSituation& situation);

/// A ball from `ball` in the direction `yaw`, to `stops`, comes too near to the own goal.
bool isTowardsOwnGoal(const WorldModel& world, const Point& ball, double yaw, const Point& stops);

}  // namespace pitchboard::link
