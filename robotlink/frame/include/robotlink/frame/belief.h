// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot believes and perceives, from its blackboard or its messages, in the studio's frame.
// Pure functions.

#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// Where it believes to stand. Nothing while its localization does not work.
std::optional<Pose> believedPose(const sim::FieldSpec& field, const RobotBoardView& board);

/// The ball of one who stands at `origin` and sees it in this distance and direction (left of its
/// nose). Nothing for what can be no ball: no distance, or one of twice the field.
std::optional<Point> ballSeenFrom(const Pose& origin, double distance_cm, double bearing_deg,
                                  const sim::FieldSpec& field);

/// Where it believes to stand, or stands where it does not say.
Pose perceivingPose(const sim::FieldSpec& field, const RobotFrame& robot);

/// Where a robot sees the ball, by its message or its blackboard. Nothing while it sees none, or is
/// not heard any more.
std::optional<Point> perceivedBall(const sim::FieldSpec& field, const RobotFrame& robot);

/// How full its battery is. Nothing while it tells no voltage.
std::optional<telemetry::Battery> batteryOf(const RobotFrame& robot);

/// The ball that most of the robots agree on; empty when no two do. `see` counts all of `balls`.
std::optional<TeamBall> agreedBall(const std::vector<Point>& balls);

}  // namespace pitchboard::link
