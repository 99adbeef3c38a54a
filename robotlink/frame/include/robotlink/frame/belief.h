// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot believes and perceives, from the view of its blackboard, in the studio's frame.

#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// Where it believes to stand. Nothing while its localization does not work.
std::optional<Pose> believedPose(const sim::FieldSpec& field, const RobotBoardView& board);

/// Where it sees the ball, when it stands at `origin`. Nothing while it sees none.
std::optional<Point> perceivedBall(const sim::FieldSpec& field, const RobotBoardView& board,
                                   const Pose& origin);

/// The ball that most of the robots agree on; empty when no two do. `see` counts all of `balls`.
std::optional<TeamBall> agreedBall(const std::vector<Point>& balls);

}  // namespace pitchboard::link
